# cmake -P script: every header of the project that FILES (in the tree at ROOT) include must lie in one of the folders
# VISIBLE, and each third-party library may be included by the files that wrap it only. Touches STAMP when all is well.

cmake_minimum_required(VERSION 3.25)

# Library header pattern, then the files allowed to include it.
set(wrapped
    "<embree[34]/" "^accel/embree_[a-z]+\\.(h|cpp)$"
    "<hwy/" "^(src/core/instruction_sets\\.h|accel/grid_[a-z]+-inl\\.h|(accel/grid_trace|src/lights/(weigh_emitters|weigh_wholes)|src/render/camera_rays|(accel|integrators|src/[a-z]+)/[a-z_]+_wave)\\.cpp)$"
    "<pugixml" "^src/scene/"
    "<tiny_obj_loader" "^tests/"
    "<OpenImageIO/" "^src/(render|shading)/"
    "<CLI/" "^src/app/"
    "<nlohmann/" "^src/app/"
    "<boost/math" "^src/measure/significance\\.cpp$"
    "<boost/multiprecision" "^src/oracle/exact\\.cpp$"
    "<(tbb|oneapi)/" "^src/core/tbb_loop\\.cpp$")

function(check_project_include file header)
  cmake_path(GET header PARENT_PATH folder)
  if(NOT folder IN_LIST VISIBLE)
    message(FATAL_ERROR "${file}: includes \"${header}\", which its layer may not see.\n"
                        "  It may include: ${VISIBLE}. The order of the layers is in CMakeLists.txt.")
  endif()
endfunction()

function(check_library_include file line)
  set(rules ${wrapped})
  while(rules)
    list(POP_FRONT rules header owner)
    if(line MATCHES "${header}" AND NOT file MATCHES "${owner}")
      message(FATAL_ERROR "${file}: ${line}: this library is wrapped by the files ${owner} alone")
    endif()
  endwhile()
endfunction()

foreach(path IN LISTS FILES)
  cmake_path(RELATIVE_PATH path BASE_DIRECTORY ${ROOT} OUTPUT_VARIABLE file)
  file(STRINGS ${path} includes REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS includes)
    if(line MATCHES "\"([^\"]+)\"|<((src|accel|integrators)/[^>]+)>")
      check_project_include(${file} ${CMAKE_MATCH_1}${CMAKE_MATCH_2})
    else()
      check_library_include(${file} "${line}")
    endif()
  endforeach()
endforeach()
cmake_path(GET STAMP PARENT_PATH stamp_folder)
file(MAKE_DIRECTORY ${stamp_folder})
file(TOUCH ${STAMP})
