# How every target of the project is compiled. Floating-point expressions are never contracted, so that filters and
# placements give the same bits at every optimisation level and with every compiler.
# GCC 12 drops double(float(x)) from two neighbouring doubles where its SLP vectorizer joins them (-O2 and above; as in
# p = {float(p.x), float(p.y), float(p.z)}), so that hulls would not be rounded to float32 before they are certified. The
# test Float32.RoundsEveryCoordinate finds compilers that do.
# GCC collects its own garbage from a gigabyte on: it compiles in nine tenths of the time, and takes up to 1.3 GB.
function(prohull_compile_options target)
  target_compile_options(${target} PRIVATE
    -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-qual
    "$<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize;--param=ggc-min-heapsize=1000000>"
    $<$<BOOL:${PROHULL_WERROR}>:-Werror>)
  if(PROHULL_SANITIZE)
    # Not the five checks of every access: a null pointer ends the program anyway, the address sanitizer sees what is outside
    # of its object, and the tests would take half as long again to compile.
    target_compile_options(${target} PRIVATE
      -fsanitize=${PROHULL_SANITIZE} -fno-sanitize=null,alignment,object-size,vptr,pointer-overflow -fno-sanitize-recover=all
      -fno-omit-frame-pointer)
    # GCC's manual: the sanitizers make this warning wrong; it finds uninitialized values in CGAL's conversions.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    target_link_options(${target} PRIVATE -fsanitize=${PROHULL_SANITIZE})
  endif()
  if(PROHULL_FUZZ)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
endfunction()

# prohull_compile_alone(TARGET SOURCES...): sources that have names in common with others, in their unnamed namespaces. The presets
# release and sanitize compile sixteen sources at a time (CMAKE_UNITY_BUILD).
function(prohull_compile_alone target)
  set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
