# One target a folder, and the order of the folders enforced: a file may include its own folder and the folders
# its target USES, directly or through them. GLOBAL_DEPENDS_NO_CYCLES refuses cycles between the targets;
# CheckLayers.cmake refuses includes that the link line does not show.

# All folders that target NAME may include, as a list of source paths, into OUT.
function(lemma_visible_folders name out)
  get_target_property(folder lemma_${name} LEMMA_FOLDER)
  set(folders ${folder})
  get_target_property(uses lemma_${name} LEMMA_USES)
  foreach(used IN LISTS uses)
    lemma_visible_folders(${used} below)
    list(APPEND folders ${below})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  set(${out} ${folders} PARENT_SCOPE)
endfunction()

# Records folder and uses on TARGET and checks its includes whenever one of its files changes.
function(lemma_guard_layer target folder uses files)
  set_target_properties(${target} PROPERTIES LEMMA_FOLDER ${folder} LEMMA_USES "${uses}")
  set(visible ${folder})
  foreach(used IN LISTS uses)
    lemma_visible_folders(${used} below)
    list(APPEND visible ${below})
  endforeach()
  list(REMOVE_DUPLICATES visible)
  set(stamp ${PROJECT_BINARY_DIR}/layers/${target}.stamp)
  add_custom_command(
    OUTPUT ${stamp}
    COMMAND ${CMAKE_COMMAND} -D "FILES=${files}" -D "VISIBLE=${visible}" -D "ROOT=${PROJECT_SOURCE_DIR}" -D
            "STAMP=${stamp}" -P ${PROJECT_SOURCE_DIR}/cmake/CheckLayers.cmake
    DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/CheckLayers.cmake
    COMMENT "Layering of ${folder}"
    VERBATIM)
  add_custom_target(${target}_layer ALL DEPENDS ${stamp})
  add_dependencies(${target} ${target}_layer)
endfunction()

# lemma_folder(NAME FOLDER [USES names...] [LINKS targets...] [PRIVATE_LINKS targets...]): the library lemma_NAME of
# all sources and headers in FOLDER.
function(lemma_folder name folder)
  cmake_parse_arguments(arg "" "" "USES;LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.h)
  add_library(lemma_${name} STATIC ${sources})
  target_sources(lemma_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
  list(TRANSFORM arg_USES PREPEND lemma_ OUTPUT_VARIABLE used_targets)
  target_link_libraries(lemma_${name} PUBLIC ${used_targets} ${arg_LINKS} PRIVATE ${arg_PRIVATE_LINKS} lemma_compiler)
  lemma_guard_layer(lemma_${name} ${folder} "${arg_USES}" "${sources};${headers}")
endfunction()

# lemma_program(NAME FOLDER USES names... LINKS targets...): the executable NAME of all files in FOLDER.
function(lemma_program name folder)
  cmake_parse_arguments(arg "" "" "USES;LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.h)
  add_executable(${name} ${sources})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(${name} PRIVATE LEMMA_VERSION="${PROJECT_VERSION}")
  list(TRANSFORM arg_USES PREPEND lemma_ OUTPUT_VARIABLE used_targets)
  target_link_libraries(${name} PRIVATE ${used_targets} ${arg_LINKS} lemma_compiler)
  lemma_guard_layer(${name} ${folder} "${arg_USES}" "${sources};${headers}")
endfunction()
