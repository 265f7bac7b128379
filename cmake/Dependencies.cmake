# The libraries Lemma stands on, all from the distribution. Each is required; a missing one names its package.

# Finds PACKAGE or stops, naming the Debian package to install. Further arguments go to find_package.
function(lemma_require package debian)
  set(CMAKE_MESSAGE_LOG_LEVEL ERROR) # Imath's configuration reports Python bindings that nobody asked for
  find_package(${package} QUIET GLOBAL ${ARGN})
  if(NOT ${package}_FOUND)
    message(FATAL_ERROR "${package} was not found.\n  On Debian and Ubuntu: apt install ${debian}")
  endif()
endfunction()

lemma_require(Imath libimath-dev CONFIG)
lemma_require(TBB libtbb-dev CONFIG)
lemma_require(Boost libboost-dev CONFIG)
lemma_require(pugixml libpugixml-dev CONFIG)
lemma_require(OpenEXR libopenexr-dev CONFIG) # OpenImageIO's own configuration needs it but does not look for it
lemma_require(OpenImageIO "libopenimageio-dev openimageio-tools" CONFIG) # its configuration checks for the tools
lemma_require(hwy libhwy-dev CONFIG)
lemma_require(CLI11 libcli11-dev CONFIG)
lemma_require(fmt libfmt-dev CONFIG)
lemma_require(nlohmann_json nlohmann-json3-dev CONFIG)

# Debian's OpenImageIO names the headers of OpenCV, which its library uses but its users need not have installed.
get_target_property(oiio_include_dirs OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
list(FILTER oiio_include_dirs EXCLUDE REGEX "opencv")
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${oiio_include_dirs}")

# Embree 4 is taken before 3; accel/embree_api.h hides what differs.
find_package(embree 4 CONFIG QUIET GLOBAL)
if(NOT embree_FOUND)
  find_package(embree 3 CONFIG QUIET GLOBAL)
endif()
if(NOT embree_FOUND)
  message(FATAL_ERROR "Embree 4 or 3 was not found.\n  On Debian and Ubuntu: apt install libembree-dev")
endif()
message(STATUS "Embree ${embree_VERSION} found in ${embree_DIR}")
add_library(lemma_embree INTERFACE)
target_link_libraries(lemma_embree INTERFACE embree)
