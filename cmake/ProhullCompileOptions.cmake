# How every target of the project is compiled. Floating-point expressions are never contracted, so that filters and
# placements give the same bits at every optimisation level and with every compiler.
function(prohull_compile_options target)
  target_compile_options(${target} PRIVATE
    -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-qual
    $<$<BOOL:${PROHULL_WERROR}>:-Werror>)
  if(PROHULL_SANITIZE)
    target_compile_options(${target} PRIVATE
      -fsanitize=${PROHULL_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${PROHULL_SANITIZE})
  endif()
  if(PROHULL_FUZZ)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
endfunction()
