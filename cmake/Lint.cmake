# `lint`: formatting (clang-format) and defects (clang-tidy) over all C++ files of the tree.
find_program(CLANG_FORMAT clang-format)
find_program(RUN_CLANG_TIDY NAMES run-clang-tidy run-clang-tidy-14 run-clang-tidy-19)
file(GLOB_RECURSE lint_files CONFIGURE_DEPENDS src/*.h src/*.cpp accel/*.h accel/*.cpp integrators/*.h
     integrators/*.cpp tests/*.h tests/*.cpp bench/*.h bench/*.cpp fuzz/*.h fuzz/*.cpp)

if(CLANG_FORMAT)
  add_custom_target(format COMMAND ${CLANG_FORMAT} -i ${lint_files} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM)
  add_custom_target(check_format COMMAND ${CLANG_FORMAT} --dry-run -Werror ${lint_files}
                    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM)
endif()
if(CLANG_FORMAT AND RUN_CLANG_TIDY)
  add_custom_target(lint COMMAND ${RUN_CLANG_TIDY} -quiet -p ${PROJECT_BINARY_DIR} "${PROJECT_SOURCE_DIR}/(src|accel|integrators)/"
                    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM)
  add_dependencies(lint check_format)
else()
  add_custom_target(lint COMMAND ${CMAKE_COMMAND} -E echo "lint needs: apt install clang-format clang-tidy"
                    COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
endif()
