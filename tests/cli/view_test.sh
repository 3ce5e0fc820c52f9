# What `prohull view` refuses, and what it writes. Pages are opened in a browser by tests/view.

expect 0 "sample" "$prohull" sample box -o box.stl --faces 100
if ! "$prohull" view box.stl -o page.html >out 2>err && grep -q "built without the page" err; then
  echo "skipped: prohull was built without the page of prohull view"
  exit 77
fi
is "a page" [ -s page.html ]
says page.html "the page allows no request" "default-src 'none'"

expect 2 "another suffix" "$prohull" view box.stl -o page.png
says err "another suffix" ".html"
expect 2 "page over its input" "$prohull" view box.stl -o box.html --original box.html
expect 3 "no such file" "$prohull" view nothing.stl -o nothing.html
says err "no such file" "nothing.stl"
absent nothing.html "no page of nothing"
expect 2 "too many files" "$prohull" view box.stl box.stl box.stl box.stl box.stl box.stl box.stl box.stl box.stl -o many.html
says err "too many files" "8 files at most"
expect 0 "to standard output" "$prohull" view box.stl -o -
says out "to standard output" "<!DOCTYPE html>"

printf 'v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >nan.obj
expect 3 "nothing finite" "$prohull" view nan.obj -o nan.html
says err "nothing finite" "nan.obj: it has no finite face to show"
expect 0 "units" "$prohull" view box.stl --original box.stl --unit mm -o units.html
says units.html "units" '"unit":"m"'
for option in "--unit mm" "--scale 2"; do
  expect 2 "$option of nothing" "$prohull" view box.stl $option -o nothing.html
  says err "$option of nothing" "--original"
done
absent nothing.html "a unit of nothing"
expect 0 "the same page twice" "$prohull" view box.stl --original box.stl --unit mm -o again.html --threads 1
is "the same page twice" cmp units.html again.html

"$prohull" sample bracket -o bracket.ply --faces 300 >/dev/null
"$prohull" convex bracket.ply --pieces 3 -o piece.stl >/dev/null
expect 0 "pieces of several files" "$prohull" view --union piece_*.stl --original bracket.ply -o union.html
says union.html "pieces of several files" "\"union\":\"$(ls piece_*.stl | wc -l) pieces\""
says union.html "pieces of several files" '"verification":{"answer":"yes"'

# --- the page that `prohull urdf` writes beside its report ---
expect 0 "sample" "$prohull" sample gripper -o gripper
robot="$prohull urdf gripper/gripper.urdf --faces 60 --configurations 5 --no-cache"
expect 0 "a robot" $robot -o safe
says safe/report.html "a robot: the report links to it" '<a href="view.html#'
says safe/view.html "a robot: within its hulls" '"name":"sample_gripper with hulls"'
says safe/view.html "a robot: as shipped" '"name":"sample_gripper as shipped"'
expect 0 "a robot: once more" $robot -o safe
says out "a robot: once more" "up to date"
expect 0 "a robot without pictures" $robot -o safe --no-pictures
absent safe/view.html "a robot without pictures"
is "a robot without pictures: no link" sh -c '! grep -q view.html safe/report.html'
