# Does with a small project (this folder) what docs/install.md says: it uses prohull installed and moved elsewhere, by
# CMake and by pkg-config, and within its own tree, where the library is not built again: what the project would link is
# linked with the one that was built.
#   cmake -DROOT=<source tree of prohull> -DBUILD=<its build tree> -DLIBRARY=<the library in it>
#         -DWORK=<folder of the test> -DCOMPILER=<c++> -P run.cmake
cmake_policy(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()

# The blocks of docs/install.md in a language, in their order.
function(blocks language result)
  file(READ ${ROOT}/docs/install.md text)
  string(REPLACE ";" "\;" text "${text}")
  string(REGEX MATCHALL "\n```${language}\n[^`]*\n```" found "${text}")
  list(TRANSFORM found REPLACE "\n```${language}\n|\n```" "\n")
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

# configure(NAME SNIPPET [OPTIONS...]): the project in ${WORK}/NAME, built in ${WORK}/NAME/build.
function(configure name snippet)
  file(COPY ${ROOT}/tests/consumer/ DESTINATION ${WORK}/${name} PATTERN run.cmake EXCLUDE)
  file(WRITE ${WORK}/${name}/snippet.cmake "${snippet}")
  if(snippet MATCHES "add_subdirectory")
    file(CREATE_LINK ${ROOT} ${WORK}/${name}/prohull SYMBOLIC)
  endif()
  execute_process(
    COMMAND ${CMAKE_COMMAND} -S ${WORK}/${name} -B ${WORK}/${name}/build -G Ninja -DSNIPPET=${WORK}/${name}/snippet.cmake
            -DCMAKE_CXX_COMPILER=${COMPILER} ${ARGN}
    RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(failed ${failed} PARENT_SCOPE)
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(require_configured)
  configure(${ARGV})
  if(failed)
    message(FATAL_ERROR "${output}")
  endif()
endfunction()

function(absent pattern text what)
  string(REGEX MATCH "[^\n]*(${pattern})[^\n]*" found "${text}")
  if(found)
    message(FATAL_ERROR "${what}: ${found}")
  endif()
endfunction()

# A project with prohull in it stays as it was, and so do its compiler's options.
function(check_parent name)
  file(READ ${WORK}/${name}/build/CMakeCache.txt cache)
  absent("\nBUILD_TESTING:" "${cache}" "prohull decides whether the project has tests")
  absent("\nCMAKE_BUILD_TYPE:[A-Z]+=[^\n]" "${cache}" "prohull chooses the build type of the project")
  string(REGEX REPLACE "\n(CMAKE|PROHULL|FETCHCONTENT|CGAL|Boost|PKG_CONFIG|TBB)_[^\n]*" "" rest "${cache}")
  absent("\n[A-Za-z0-9_]+:(BOOL|STRING)=" "${rest}" "prohull has an option of another name")
  execute_process(COMMAND ninja -C ${WORK}/${name}/build -t targets all OUTPUT_VARIABLE targets COMMAND_ERROR_IS_FATAL ANY)
  absent("/(apps|tests|bench|python|examples)/[^\n]*\\.o:" "${targets}" "prohull builds more than its library")
  execute_process(COMMAND ninja -C ${WORK}/${name}/build -t commands mine OUTPUT_VARIABLE commands COMMAND_ERROR_IS_FATAL ANY)
  absent("-Werror" "${commands}" "prohull makes warnings errors")
  if(NOT commands MATCHES "-std=c\\+\\+20 [^\n]*-ffp-contract=off|-ffp-contract=off [^\n]*-std=c\\+\\+20 ")
    message(FATAL_ERROR "the library is not compiled as it should be: ${commands}")
  endif()
  string(REGEX MATCH "[^\n]* -c [^\n]*/mine.cpp\n" of_mine "${commands}")
  absent("-ffp-contract|-W|-frounding-math" "${of_mine}" "prohull changes how the project is compiled")
  run(${CMAKE_COMMAND} --install ${WORK}/${name}/build --prefix ${WORK}/${name}/installed)
  file(GLOB_RECURSE installed ${WORK}/${name}/installed/*)
  absent("." "${installed}" "prohull installs itself with the project")
endfunction()

blocks(cmake cmake_blocks)
list(LENGTH cmake_blocks count)
if(NOT count EQUAL 3)
  message(FATAL_ERROR "docs/install.md has ${count} blocks of CMake; the test knows 3")
endif()
list(GET cmake_blocks 0 with_find_package)
list(GET cmake_blocks 1 with_add_subdirectory)
list(GET cmake_blocks 2 with_fetch_content)
blocks(sh shell_blocks)
list(FILTER shell_blocks INCLUDE REGEX pkg-config)

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)
file(RENAME ${WORK}/installed ${WORK}/moved)
file(GLOB_RECURSE scripts ${WORK}/moved/*.cmake ${WORK}/moved/*.pc)
foreach(script ${scripts})
  file(READ ${script} text)
  absent("${BUILD}|${ROOT}|${WORK}" "${text}" "${script} knows where it was made")
endforeach()

require_configured(package "${with_find_package}" -DCMAKE_PREFIX_PATH=${WORK}/moved)
run(${CMAKE_COMMAND} --build ${WORK}/package/build)
run(${WORK}/package/build/mine)

string(REPLACE 0.1 0.2 with_another_version "${with_find_package}")
configure(version "${with_another_version}" -DCMAKE_PREFIX_PATH=${WORK}/moved)
if(NOT failed OR NOT output MATCHES "compatible")
  message(FATAL_ERROR "a version that is not there is found: ${output}")
endif()

file(GLOB_RECURSE pc ${WORK}/moved/prohull.pc)
cmake_path(GET pc PARENT_PATH pc)
cmake_path(GET pc PARENT_PATH libraries)
string(REPLACE "c++ " "${COMPILER} " compile "${shell_blocks}")
file(COPY ${ROOT}/tests/consumer/mine.cpp DESTINATION ${WORK}/pkg-config)
execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${pc} sh -e -c "${compile}"
                WORKING_DIRECTORY ${WORK}/pkg-config COMMAND_ERROR_IS_FATAL ANY)
run(${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${libraries} ${WORK}/pkg-config/mine)

require_configured(subdirectory "${with_add_subdirectory}")
check_parent(subdirectory)
if(LIBRARY MATCHES "\\.a$")
  set(build ${WORK}/subdirectory/build)
  run(${CMAKE_COMMAND} --build ${build} --target CMakeFiles/mine.dir/mine.cpp.o)
  file(GLOB made RELATIVE ${build} ${build}/prohull/src/*.a)
  absent("." "${made}" "the library was built again")
  file(COPY ${LIBRARY} DESTINATION ${build}/prohull/src)
  execute_process(COMMAND ninja -C ${build} -t commands mine OUTPUT_VARIABLE commands COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "[^\n]*-o mine [^\n]*" link "${commands}")
  execute_process(COMMAND sh -c "${link}" WORKING_DIRECTORY ${build} COMMAND_ERROR_IS_FATAL ANY)
  run(${build}/mine)
endif()

require_configured(fetched "${with_fetch_content}" -DFETCHCONTENT_SOURCE_DIR_PROHULL=${ROOT})
check_parent(fetched)
