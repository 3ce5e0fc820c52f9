# Drives `prohull cage` as a user would
$prohull sample torus --faces 600 -o torus.ply >/dev/null
cage="$prohull cage torus.ply --faces 150"

# --- the main job ---
expect 0 "a pair" $cage -o outer.obj --inner inner.obj --strict --report pair.json
says out "a pair: the outer hull" "outer.obj: outer hull of 150 faces"
says out "a pair: the inner hull" "inner.obj: inner hull of 150 faces"
says out "a pair: shapes" "smallest angle"
says out "a pair: the gap" "gap: at least"
says out "a pair: disjoint" "disjoint: yes, no face touches the mesh, the other hull or itself"
is "a pair: the default gap is an option" sh -c "! grep -q '\"gap\": 0\\.0,' pair.json"
says pair.json "a pair: report" '"disjoint": true'
expect 0 "the outer hull encloses" $prohull verify outer.obj torus.ply
expect 0 "the inner hull is enclosed" $prohull verify torus.ply inner.obj
expect 0 "an outer hull alone" $cage -o alone.obj
is "it is that of the pair" cmp alone.obj outer.obj
expect 0 "even" $cage --even -o even.obj --strict --report even.json
is "even: no angle below 17 degrees" \
  test "$(sed -n 's/.*"smallest_angle_degrees": \([0-9]*\)\..*/\1/p' even.json)" -ge 17
expect 0 "a gap" $cage --gap 0.05 -o wide.stl --report wide.json
says wide.json "a gap is kept" '"keeps_gap": true'
expect 0 "fewer faces inside" $cage -o outer.obj --inner few.obj --inner-faces 100
says out "fewer faces inside" "few.obj: inner hull of 100 faces"
expect 0 "standard output" $cage -o - --out-format obj
is "standard output has the same bytes" cmp out alone.obj

expect 1 "a gap that the inner hull does not keep" $cage --gap 0.5 -o far.obj --inner near.obj --strict
says out "a gap that the inner hull does not keep" "NOT the 0.5 asked for: no inner hull that keeps it was found"

printf 'OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1e-5\n1 0 1e-5\n1 1 1e-5\n0 1 1e-5\n' >plate.off
printf '4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n' >>plate.off
expect 0 "a plate of a hundredth of the gap" $prohull cage plate.off -o far.obj --inner near.obj
says out "a plate of a hundredth of the gap" "with --gap, an inner hull may keep it, with less volume"

# --- what cannot be ---
expect 2 "no inner hull, but its faces" $cage -o a.obj --inner-faces 100
says err "no inner hull, but its faces" "--inner"
expect 2 "two hulls in one file" $cage -o a.obj --inner a.obj
expect 2 "a gap of nothing" $cage -o a.obj --gap 0
printf 'OFF\n0 0 0\n' >empty.off
expect 3 "no faces" $prohull cage empty.off -o a.obj
says err "no faces" "empty.off: the mesh has no faces: nothing to enclose"
printf 'OFF\n4 4 0\n0 0 0\n1e200 0 0\n0 1e200 0\n0 0 1e200\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >far.off
for gap in "" "--gap 1%"; do
  expect 3 "coordinates that overflow, $gap" $prohull cage far.off -o a.obj --inner b.obj $gap
  says err "coordinates that overflow, $gap" "far.off: coordinates reach 1e+200; beyond 1e+100 volumes overflow: scale the mesh"
done
printf 'OFF\n3 1 0\n1 2 3\n1 2 3\n1 2 3\n3 0 1 2\n' >point.off
for command in "build -o a.obj" "cage -o a.obj" "convex -o a.obj" "spheres -o a.yaml" "repair -o a.obj"; do
  expect 3 "a point: $command" $prohull ${command%% *} point.off ${command#* }
  says err "a point: $command" "point.off: all points of the mesh are one, (1, 2, 3): there is nothing to enclose but a point"
done
printf 'OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n' >sheet.off
expect 0 "a sheet" $prohull cage sheet.off -o sheet.obj --strict
expect 3 "an inner hull of a sheet" $prohull cage sheet.off -o a.obj --inner b.obj
says err "an inner hull of a sheet: where" "sheet.off"
is "nothing is written then" test ! -e a.obj -a ! -e b.obj
