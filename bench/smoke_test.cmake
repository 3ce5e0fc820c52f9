# Every table runs on a small sample and has its columns.
function(run)
  execute_process(COMMAND ${BENCH} ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE text)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "prohull-bench ${ARGN}: exit code ${status}\n${text}")
  endif()
  set(printed "${text}" PARENT_SCOPE)
endfunction()

function(expect text what)
  string(FIND "${text}" "${what}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "expected \"${what}\" in:\n${text}")
  endif()
endfunction()

file(REMOVE_RECURSE ${OUT})
run(construction --samples asteroid --sample-faces 2000 --faces 400,100 --repeat 1 --out ${OUT})
foreach(column "| model | faces | paper1 | paper2 | paper1 / paper2 |" "| model | hull | paper1 | paper's 1st |"
        "| model | faces | lazy | CGAL Garland-Heckbert |" "| asteroid | 1")
  expect("${printed}" "${column}")
endforeach()
file(READ ${OUT}/construction.csv csv)
expect("${csv}" "mesh,faces,strategy,hull_faces,void_percent,paper_void_percent,seconds,paper_seconds,")
file(READ ${OUT}/construction.md markdown)
expect("${printed}" "${markdown}")

run(queues --samples asteroid --sample-faces 2000 --faces 400 --repeat 1)
expect("${printed}" "| model | strategy | heap | red-black tree | buckets |")
run(memory --samples asteroid --sample-faces 2000 --faces 400)
expect("${printed}" "| model | faces | mesh | peak | bytes per face |")

run(queries --samples asteroid --sample-faces 2000 --segments 100 --check 300 --repeat 1 --out ${OUT})
foreach(column "| model | strategy | base | time | brute force / time |" "| model | segments that meet | paper's | 6-DOPs |"
        "| model | engine | first | any | all |" "| model | batch | between queries | time |"
        "| model | engine | index | query object |" "| asteroid | bvh | 300 |" "| asteroid | paper-refinement | 300 |")
  expect("${printed}" "${column}")
endforeach()
file(READ ${OUT}/queries.md markdown)
expect("${printed}" "${markdown}")
foreach(table table3 figure8 table4 trees updates query_memory correctness)
  file(READ ${OUT}/${table}.csv csv)
  expect("${csv}" "\nasteroid,")
endforeach()
