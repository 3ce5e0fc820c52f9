# Reads every include of include/, src/, render/, robot/, view/, paper/, apps/, examples/, python/ and js/, and fails if one points against the flow.
# cmake -DROOT=<repository> -P layering.cmake
cmake_policy(VERSION 3.25)

# room(<folder of src/> OWNS <public headers that it implements> MAY <folders that it may include>)
# An include of a public header counts as an include of the folder that owns it. MAY also takes single headers, as
# prohull/<name> or <folder>/<name>: then only these are seen of that folder.
set(rooms "")
macro(room name)
  cmake_parse_arguments(room "" "" "OWNS;MAY" ${ARGN})
  list(APPEND rooms ${name})
  set(owns_${name} ${room_OWNS})
  set(may_${name} ${name} ${room_MAY})
endmacro()

room(base      OWNS detail/extension detail/refuse detail/rounded detail/scramble error detail/names detail/stopwatch detail/text progress)
room(geometry  OWNS geometry detail/shapes                                                     MAY base)
room(parallel  OWNS detail/progress_meter detail/threads                         MAY base)
room(mesh      OWNS detail/disjoint_sets detail/finite detail/ids length triangle_mesh detail/vertex_split mesh_report detail/mesh_quality detail/mesh_marks regions detail/symmetry MAY geometry base)
room(hull      OWNS progressive_hull                                             MAY mesh geometry base)
room(query     OWNS mesh_query                                                       MAY hull mesh geometry parallel base)
room(io        OWNS detail/base64 detail/memory mesh_io detail/missing_file detail/percents hull_file detail/query_io detail/run_program                            MAY hull mesh geometry parallel base
                                                                                     prohull/collide prohull/mesh_query)
room(repair    OWNS detail/openings repair                                              MAY mesh geometry base)
room(construct OWNS hull_builder tight_hull detail/float32_hull padded_hull detail/mesh_part   MAY hull mesh geometry parallel base)
# Shares nothing with the construction of hulls but the exact predicates: of mesh/ and hull/ only what it judges, and
# whether that is closed.
room(verify    OWNS enclosure verification union_verification verdict detail/verdict_parts detail/replay distance tolerances detail/solid_pieces detail/inside_out MAY geometry parallel base prohull/detail/ids
                                                                                     prohull/detail/disjoint_sets
                                                                                     prohull/triangle_mesh
                                                                                     mesh/closed
                                                                                     prohull/detail/vertex_split
                                                                                     prohull/progressive_hull
                                                                                     prohull/mesh_query prohull/collide)
room(sample    OWNS sample detail/random_segments                                       MAY mesh geometry base prohull/detail/memory)
room(wrap      OWNS convex_hull wrap                                                         MAY mesh geometry parallel base)
room(enclose   OWNS cage closed_solid detail/closed_original detail/summary enclosing_hull                                          MAY construct repair verify wrap hull mesh
                                                                                     geometry parallel base prohull/collide
                                                                                     cover/few_vertices cover/polytope)

room(cover     OWNS convex_cover detail/cover_summary detail/given_options detail/told_notes sphere_cover sweep               MAY enclose construct repair verify wrap hull mesh
                                                                                     geometry parallel base
                                                                                     prohull/mesh_query prohull/collide)
room(certificate OWNS certificate                                                MAY verify hull mesh geometry parallel base)
room(collide   OWNS collide detail/collision_levels detail/drift                                         MAY mesh geometry parallel base
                                                                                     prohull/progressive_hull)

# Outside of src/: public headers, all of them, and these folders.
set(outside render robot view paper apps examples python js)
set(may_render render)
set(may_robot robot render)
set(may_view view robot)
# Its engines are as those of src/query, and it looks at single collapses.
set(may_paper paper query hull mesh geometry construct/placement construct/shape_guards construct/star)
set(may_apps render robot view paper)
set(may_examples "")
set(may_python render robot view paper)
set(may_js view robot paper)

set(failures "")
macro(fail)
  string(APPEND failures "\n  " ${ARGN})
endmacro()

# --- every public header has one owner ---
set(owned "")
foreach(room ${rooms})
  foreach(header ${owns_${room}})
    if(header IN_LIST owned)
      fail("prohull/${header}.h has two owners, ${owner_${header}} and ${room}")
    endif()
    list(APPEND owned ${header})
    set(owner_${header} ${room})
    if(NOT EXISTS ${ROOT}/include/prohull/${header}.h)
      fail("prohull/${header}.h, which ${room} owns, does not exist")
    endif()
  endforeach()
endforeach()
file(GLOB_RECURSE headers RELATIVE ${ROOT}/include/prohull ${ROOT}/include/prohull/*.h)
foreach(header ${headers})
  string(REGEX REPLACE "\\.h$" "" header ${header})
  if(NOT header IN_LIST owned)
    fail("prohull/${header}.h has no owner here")
  endif()
endforeach()

# --- every include follows the flow ---
file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/include/*.h ${ROOT}/src/*.h ${ROOT}/src/*.cpp ${ROOT}/render/*.h
     ${ROOT}/render/*.cpp ${ROOT}/robot/*.h ${ROOT}/robot/*.cpp ${ROOT}/view/*.h ${ROOT}/view/*.cpp ${ROOT}/paper/*.h ${ROOT}/paper/*.cpp ${ROOT}/apps/*.h ${ROOT}/apps/*.cpp ${ROOT}/examples/*.cpp ${ROOT}/python/*.h ${ROOT}/python/*.cpp
     ${ROOT}/js/bindings/*.h ${ROOT}/js/bindings/*.cpp)
list(LENGTH sources count)
if(count LESS 20)
  message(FATAL_ERROR "found only ${count} sources below ${ROOT}")
endif()
foreach(source ${sources})
  if(source MATCHES "^include/prohull/([a-z0-9_/]+)\\.h$")
    set(folder "${owner_${CMAKE_MATCH_1}}")
  else()
    string(REGEX MATCH "^(src/)?([a-z]+)/" _ ${source})
    set(folder ${CMAKE_MATCH_2})
  endif()
  if(NOT folder IN_LIST rooms AND NOT folder IN_LIST outside)
    fail("${source}: its folder ${folder} has no rule here")
    continue()
  endif()
  # CGAL, GMP and Boost are for tests and bench.
  file(STRINGS ${ROOT}/${source} numbers REGEX "^[ \t]*#[ \t]*include[ \t]*[\"<](CGAL/|boost/|gmp|mpfr)")
  if(numbers)
    fail("${source}: exact numbers are those of src/geometry/")
  endif()
  file(STRINGS ${ROOT}/${source} includes REGEX "^[ \t]*#[ \t]*include[ \t]*[\"<][a-z]+/")
  foreach(line ${includes})
    string(REGEX MATCH "([\"<])([a-z]+)/([^\">]+)\\.h" _ ${line})
    set(mark "${CMAKE_MATCH_1}")
    set(included ${CMAKE_MATCH_2})
    set(header ${CMAKE_MATCH_3})
    if(source MATCHES "^include/" AND NOT included STREQUAL prohull AND mark STREQUAL "\"")
      fail("${source}: public headers may not include ${included}/${header}.h")
    elseif(included STREQUAL prohull)
      if(NOT folder IN_LIST outside AND NOT "${owner_${header}}" IN_LIST may_${folder}
         AND NOT prohull/${header} IN_LIST may_${folder})
        fail("${source}: ${folder} may not include prohull/${header}.h of ${owner_${header}}")
      endif()
    elseif((included IN_LIST rooms OR included IN_LIST outside OR mark STREQUAL "\"")
           AND NOT included IN_LIST may_${folder} AND NOT ${included}/${header} IN_LIST may_${folder})
      fail("${source}: ${folder} may not include ${included}/${header}.h")
    endif()
  endforeach()
endforeach()
if(failures)
  message(FATAL_ERROR "includes against the flow:${failures}")
endif()
message(STATUS "${count} sources follow the flow")
