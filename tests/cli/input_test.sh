# Bad input, which ends with 3, and `prohull info`, which says beforehand what `prohull build` does
make_rock
make_unit
make_rays
make_broken

# --- bad input is 3, one line, with an address ---
# bad NAME FILE SAYS [OPTIONS]
bad() {
  # shellcheck disable=SC2086
  expect 3 "$1" $prohull build "$2" -o bad_out.ply ${4:-}
  says err "$1" "$3"
  checks=$((checks + 1))
  [ "$(wc -l <err)" -eq 1 ] || fail "$1: not one line"
  absent "bad_out.ply*" "$1"
}
head -c 1000 rock.ply >truncated.ply
bad "truncated file" truncated.ply "truncated.ply: byte"
bad "missing file" nowhere.ply "nowhere.ply: cannot read: there is no such file; look at its name and its folder"
expect 3 "folder as file" $prohull info .
says err "folder as file" "cannot read: it is a folder; name a file in it"
bad "NaN" nan.off "not finite" "--repair none"
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 9\n3 1 2 3\n3 2 0 3\n' >index.off
bad "index out of range" index.off "line 8"
bad "empty mesh" empty.off "no faces"
bad "levels" rock.phull "\`prohull lod\` makes a mesh of any of its levels"
expect 3 "empty standard input" sh -c "$prohull build - -o x.ply </dev/null"
says err "empty standard input" "standard input: it is empty"
bad "open mesh" open.off "has 1 face" "--repair none"
bad "no volume" flat.off "no volume" "--repair none"
bad "no inside" sheet.off "no inner hull" "--side inner"
bad "huge coordinates" huge.off "scale the mesh"
bad "unknown format" hull.json "hull.json"
head -c 5000 rock.phull >truncated.phull
expect 3 "truncated .phull" $prohull info truncated.phull
says err "truncated .phull" "truncated"
expect 3 "a picture of nothing" $prohull render empty.off -o bad.png
says err "a picture of nothing" "no faces"
expect 3 "a picture of NaN" $prohull render nan.off -o bad.png
expect 3 "a picture of no file" $prohull render rock.ply --over nowhere.ply -o bad.png
says err "a picture of no file" "nowhere.ply"
absent "bad.png" "bad input"

# --- info and build agree ---
cat >agree_unit.off <unit.off
for mesh in rock.ply open.off sheet.off nan.off inside_out.off flat.off empty.off huge.off; do
  expect 0 "info of $mesh" $prohull info $mesh
  possible=$(grep -c 'hull possible  yes' out)
  $prohull build $mesh --faces 100 -o agreed.ply >out 2>err
  got=$?
  checks=$((checks + 1))
  [ $got -eq $((possible ? 0 : 3)) ] || fail "info and build of $mesh: possible is $possible, build exits with $got"
done
expect 0 "info of a mesh to be wrapped" $prohull info sheet.off
says out "info of a mesh to be wrapped" "of a wrap or of the convex hull"

# --- openings ---
expect 0 "info of an open mesh" $prohull info open.off --report open.json
says out "info of an open mesh" "openings       1: "
says open.json "report: openings" '"diameter": 1.414213'
expect 0 "info of a closed mesh" $prohull info rock.ply --report closed.json
says closed.json "report: no openings" '"largest": []'

# --- what was mixed up ---
expect 3 "a mesh is no .phull" $prohull lod rock.ply -o x.ply
says err "a mesh is no .phull" "this is not a .phull file"
printf '0.25;0.25;-0.5;0;0;2\n' >semicolons.csv
expect 0 "semicolons" $prohull query unit.off --rays semicolons.csv
says out "semicolons" "1 hit; 1 of 1 rays hit"
