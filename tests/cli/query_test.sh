# Drives `prohull query`
engines="bvh kdop6 kdop14 kdop18 kdop26 kdop6-overlap kdop14-overlap kdop18-overlap kdop26-overlap brute"
make_rock
make_inner
make_unit

# --- queries ---
# Two segments through the tetrahedron and one past it.
printf 'x0,y0,z0,x1,y1,z1\n0.25,0.25,-0.5,0.25,0.25,1.5\n5,5,5,6,6,6\n2,0.25,0.25,-2,0.25,0.25\n' >three.csv
expect 0 "query" $prohull query unit.off --segments three.csv -o hits.csv --mode all --report query.json
printf 'segment,t,face,x,y,z,entering\n0,0.25,0,0.25,0.25,0,1\n0,0.5,2,0.25,0.25,0.5,0\n' >expected.csv
printf '2,0.375,2,0.5,0.25,0.25,1\n2,0.5,3,0,0.25,0.25,0\n' >>expected.csv
same "all hits" hits.csv expected.csv
says out "query tells hits" "4 hits; 2 of 3 segments hit"
says query.json "report: hits" '"hits": 4'
says query.json "report: seconds" '"query":'
expect 0 "first hits" $prohull query unit.off --segments three.csv -o hits.csv --mode first
grep -v ',0$' expected.csv >first.csv
same "first hits" hits.csv first.csv
expect 0 "any hits" $prohull query unit.off --segments three.csv -o hits.csv --mode any
says out "any hits" "2 hits; 2 of 3 segments hit"
printf '0.25,0.25,-0.5,0,0,2\n0.25,0.25,-0.5,0,0,-1\n' >rays.csv
expect 0 "rays" $prohull query unit.off --rays rays.csv -o hits.csv
printf 'ray,t,face,x,y,z,entering\n0,0.25,0,0.25,0.25,0,1\n' >expected.csv
same "rays" hits.csv expected.csv
printf '0.1,0.1,-1,0.2,0.1,1,0.1,0.2,1\n' >triangle.csv
expect 0 "triangles" $prohull query unit.off --triangles triangle.csv -o hits.csv
printf 'triangle,face\n0,0\n0,2\n' >expected.csv
same "triangles" hits.csv expected.csv
says out "triangles" "2 faces met; 1 of 1 triangles meet some"

expect 0 "random segments" $prohull query rock.ply --random 2000 --write-segments random.npy -o random.npz
says out "random segments" "2,000 random segments, seed 1"
expect 0 "segments by npy" $prohull query rock.ply --segments random.npy -o again.npz
same "random segments, written and read" random.npz again.npz
expect 0 "another seed" $prohull query rock.ply --random 2000 --seed 2 --write-segments random.csv
cmp -s random.npy random.csv && fail "another seed gives the same segments"
expect 0 "queries of a .phull" $prohull query rock.phull --random 2000 -o again.npz
same "queries of a .phull are those of its original" random.npz again.npz
for mode in first all; do
  expect 0 "one thread" $prohull query rock.ply --segments random.npy --mode $mode -o random.csv --threads 1
  expect 0 "two threads" $prohull query rock.ply --segments random.npy --mode $mode -o again.csv --threads 2
  same "threads" random.csv again.csv
  for engine in $engines; do
    expect 0 "engine $engine" $prohull query rock.phull --segments random.npy --mode $mode -o again.csv --engine $engine
    same "engine $engine, $mode hits" random.csv again.csv
    says out "engine $engine" "engine $engine, "
  done
done
for engine in walk filter auto; do
  expect 0 "two hulls, $engine" $prohull query rock.phull --inner inner.phull --segments random.npy --mode all -o again.csv --engine $engine
  same "two hulls, $engine" random.csv again.csv
done
for engine in walk paper-refinement; do
  expect 0 "missed hits: $engine" $prohull query rock.phull --segments random.npy --engine $engine --report missed.json
  says out "missed hits: $engine" "hits may be missing: the engine $engine does not find all of them; auto does"
  says missed.json "missed hits: $engine" '"may_miss_hits": true'
done
printf '0,0,0,1,0,0,0,1,0\n' >tool.csv
expect 0 "no face is missed by a tree" $prohull query rock.phull --triangles tool.csv --engine walk
says_not out "no face is missed by a tree" "may be missing"
expect 0 "points of the walk" $prohull contains rock.phull --random 99 --engine walk
for asked in contains "distance --signed"; do
  expect 2 "paper-refinement: $asked" $prohull $asked rock.phull --random 99 --engine paper-refinement
  says err "paper-refinement: $asked" "it cannot tell what is inside; take another one, such as auto"
done
expect 0 "an outer hull, asked alone" $prohull query rock.phull --random 2000 --conservative --report conservative.json
says out "an outer hull, asked alone" "none that hits the mesh is missed"
grep -q '"side": "outer"' conservative.json || fail "the report of --conservative has no side"
expect 0 "an inner hull, asked alone" $prohull query inner.phull --random 2000 --conservative
says out "an inner hull, asked alone" "all that are hits hit the mesh too"
expect 0 "info of a pipe" sh -c "cat rock.phull | $prohull info /dev/stdin"
says out "info of a pipe" "progressive hull"

# --- queries that are refused ---
bad_query() {
  code=$1 name=$2 text=$3
  shift 3
  expect "$code" "$name" $prohull query "$@" -o bad_hits.csv
  says err "$name" "$text"
  checks=$((checks + 1))
  [ "$(wc -l <err)" -le 2 ] || fail "$name: more than two lines"
  absent "bad_hits*" "$name"
}
bad_query 2 "no hierarchy to go with an inner one" "needs a .phull file" rock.ply --inner inner.phull --random 10
bad_query 2 "two inner hulls" "the first must be an outer one" inner.phull --inner inner.phull --random 10
bad_query 2 "a mesh, conservatively" "needs a .phull file" rock.ply --conservative --random 10
bad_query 2 "one hull, to filter by" "an outer and an inner hull" rock.phull --engine filter --random 10
printf '0,0,0,1,1\n' >narrow.csv
bad_query 3 "wrong shape" "narrow.csv: line 1: there is no comma after y1" unit.off --segments narrow.csv
printf '0,0,0,1,1,1\n0,nan,0,1,1,1\n' >nan.csv
bad_query 3 "NaN" "nan.csv: line 2: y0 is nan" unit.off --segments nan.csv
printf '0,0,0,1,1,1\n1,2,3,1,2,3\n' >point.csv
bad_query 3 "no length" "point.csv: line 2: the segment's ends are equal" unit.off --segments point.csv
head -c 1000 random.npy >truncated.npy
bad_query 3 "truncated .npy" "truncated.npy: byte 128: the file ends after 18 of 2000 rows" unit.off --segments truncated.npy
for kind in segments rays triangles; do
  bad_query 3 "no $kind" "/dev/null: there are no $kind" unit.off --$kind /dev/null
done
bad_query 3 "missing segments" "nowhere.npy: cannot read" unit.off --segments nowhere.npy
bad_query 3 "unknown format of segments" "rock.phull: unknown format" unit.off --segments rock.phull
bad_query 3 "missing mesh" "nowhere.off: cannot read" nowhere.off --segments three.csv
printf 'OFF\n0 0 0\n' >empty.off
bad_query 3 "no faces" "empty.off: it has no faces" empty.off --segments three.csv
bad_query 2 "segments and rays" "--rays" unit.off --segments three.csv --rays rays.csv
bad_query 2 "no queries" "--random" unit.off
bad_query 2 "mode of triangles" "--mode" unit.off --triangles triangle.csv --mode all
bad_query 2 "seed without random" "--random" unit.off --segments three.csv --seed 3
bad_query 2 "unknown engine" "paper-refinement" unit.off --segments three.csv --engine fast
bad_query 2 "refinement of a mesh" "unit.off: this engine" unit.off --segments three.csv --engine refinement
expect 2 "hits over the segments" $prohull query unit.off --segments three.csv -o three.csv
says err "hits over the segments" "named twice"
expect 2 "hits in .txt" $prohull query unit.off --segments three.csv -o hits.txt
says err "hits in .txt" ".npz or .csv"
expect 3 "hits to no folder" $prohull query unit.off --segments three.csv -o nowhere/hits.csv
expect 0 "help of query" $prohull query --help
says out "help of query" "prohull query horse.ply"
says out "help of query has engines" "kdop26-overlap"
