# Whether layering.cmake finds what it is there to find: in a copy of the sources, one include against the flow at a time.
# cmake -DROOT=<repository> -DWORK=<scratch folder> -P layering_test.cmake
cmake_policy(VERSION 3.25)
file(REMOVE_RECURSE ${WORK})
file(COPY ${ROOT}/include ${ROOT}/src ${ROOT}/render ${ROOT}/paper ${ROOT}/apps ${ROOT}/examples ${ROOT}/python DESTINATION ${WORK}
     FILES_MATCHING PATTERN *.h PATTERN *.cpp)

function(check)
  execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${WORK} -P ${CMAKE_CURRENT_LIST_DIR}/layering.cmake
                  RESULT_VARIABLE code OUTPUT_QUIET ERROR_VARIABLE said)
  set(code ${code} PARENT_SCOPE)
  set(said "${said}" PARENT_SCOPE)
endfunction()

# refused(<source> <line added to it> <what is said>)
function(refused source line complaint)
  set(content "")
  if(EXISTS ${WORK}/${source})
    file(READ ${WORK}/${source} content)
  endif()
  file(WRITE ${WORK}/${source} "${line}\n${content}")
  check()
  if(code EQUAL 0)
    message(SEND_ERROR "${source} may have ${line}")
  elseif(NOT said MATCHES "${complaint}")
    message(SEND_ERROR "${source} with ${line}: instead of \"${complaint}\" this was said:\n${said}")
  endif()
  if(content STREQUAL "")
    file(REMOVE ${WORK}/${source})
  else()
    file(WRITE ${WORK}/${source} "${content}")
  endif()
endfunction()

# A header of src/ that is above.
refused(src/mesh/half_edge_mesh.h "#include \"construct/star.h\"" "mesh may not include construct/star.h")
# A public header counts as the folder that owns it.
refused(src/geometry/predicates.cpp "#include \"prohull/hull_builder.h\""
        "geometry may not include prohull/hull_builder.h of construct")
refused(src/verify/offenders.cpp "#include \"prohull/hull_builder.h\"" "verify may not include prohull/hull_builder.h")
refused(src/mesh/half_edge_mesh.cpp "  #  include <prohull/progressive_hull.h>" "mesh may not include")
# Public headers themselves.
refused(include/prohull/triangle_mesh.h "#include \"prohull/mesh_io.h\"" "mesh may not include prohull/mesh_io.h of io")
refused(include/prohull/enclosure.h "#include \"prohull/hull_builder.h\"" "verify may not include")
refused(include/prohull/mesh_query.h "#include \"geometry/bvh.h\"" "public headers may not include geometry/bvh.h")
# The certificate sees the record of a hull, but neither what reads it nor the connectivity that construction uses.
refused(src/verify/replay.cpp "#include \"mesh/half_edge_mesh.h\"" "verify may not include mesh/half_edge_mesh.h")
refused(src/verify/replay.cpp "#include \"prohull/mesh_report.h\"" "verify may not include prohull/mesh_report.h of mesh")
# Beside the library there are only public headers.
refused(apps/prohull/info.cpp "#include \"mesh/half_edge_mesh.h\"" "apps may not include mesh/half_edge_mesh.h")
refused(render/camera.cpp "#include \"apps/command.h\"" "render may not include apps/command.h")
refused(src/query/mesh_query.cpp "#include \"paper/engines.h\"" "query may not include paper/engines.h")
refused(src/io/mesh_io.cpp "#include \"tests/meshes.h\"" "io may not include tests/meshes.h")
# Exact numbers of others.
refused(apps/prohull/info.cpp "#include <CGAL/Lazy_exact_nt.h>" "exact numbers are those of")
refused(src/geometry/exact_number.cpp "#include <boost/multiprecision/cpp_int.hpp>" "exact numbers are those of")
refused(src/verify/cell.h "#include <gmpxx.h>" "exact numbers are those of")
# What nobody has put into the table.
refused(include/prohull/newcomer.h "#pragma once" "prohull/newcomer.h has no owner")
refused(src/newcomer/newcomer.h "#pragma once" "src/newcomer/newcomer.h: its folder newcomer has no rule")

check()
if(NOT code EQUAL 0)
  message(SEND_ERROR "the sources as they are do not follow the flow:${said}")
endif()
file(REMOVE_RECURSE ${WORK})
