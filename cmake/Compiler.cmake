# Flags shared by all targets: warnings, floating-point rules, sanitizers.
add_library(lemma_compiler INTERFACE)
# Clang's -Wshadow also takes offence at parameters of friends that have the name of a member.
target_compile_options(lemma_compiler INTERFACE -Wall -Wextra -Wconversion $<$<CXX_COMPILER_ID:GNU>:-Wshadow> -Wpedantic)
# Loops over lanes take & and | of conditions on purpose, since && and || are branches, and tell GCC alone that their
# waves do not overlap.
target_compile_options(lemma_compiler INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical
                       -Wno-bitwise-conditional-parentheses -Wno-unknown-pragmas>)
if(LEMMA_WARNINGS_AS_ERRORS)
  target_compile_options(lemma_compiler INTERFACE -Werror)
endif()

# A fused multiply-add that the compiler picks for one of two equal expressions breaks the watertight test
# (accel/watertight.h), so contraction is off for all code; no flag of -ffast-math is allowed either, except the
# two that change no result: nothing here reads errno or floating-point exceptions.
add_compile_options(-ffp-contract=off -fno-math-errno -fno-trapping-math)

if(LEMMA_SANITIZE)
  # -O1 keeps faults that a better optimiser removes with the code they stand in, and -g1 the lines of a stack: with both
  # the build takes half the time.
  add_compile_options(-fsanitize=${LEMMA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all -O1 -g1)
  add_link_options(-fsanitize=${LEMMA_SANITIZE})
endif()
if(LEMMA_SANITIZE MATCHES thread)
  # The distribution's TBB is not instrumented: half of each handshake would be seen, and reported as a race.
  set_source_files_properties(${PROJECT_SOURCE_DIR}/src/core/tbb_loop.cpp PROPERTIES COMPILE_OPTIONS
                              -fno-sanitize=thread)
endif()
