# Drives `prohull repair`, and `prohull build` of meshes that are no solid
make_rock
make_inner
make_knot
make_broken

# --- the solid of a mesh ---
awk '/^f / { n++; if (n > 10 && n < 20 || n == 100) next } { print }' inner.obj >open.obj
expect 3 "no inside" $prohull distance open.obj --random 10 --signed
says err "no inside" "\`prohull repair\` closes it"
expect 0 "one solid" $prohull contains open.obj --random 1000
says out "one solid" "openings, the largest"
grep inside out >inside_of_open
expect 0 "repair" $prohull repair open.obj -o solid.ply --report solid.json
says out "repair: openings" "openings, the largest"
$prohull contains solid.ply --random 1000 | grep inside >inside_of_solid
is "one solid" cmp inside_of_open inside_of_solid
expect 0 "repair" $prohull repair open.obj -o solid.ply --report solid.json
says out "repair: certified" "certified: yes, the file as written covers every triangle of the original, and its inside with its openings closed by"
says solid.json "repair: report" '"largest": 0.'
says solid.json "repair: source" '"source": "mesh"'
expect 0 "repair: an inside" $prohull contains solid.ply --random 10
expect 0 "repair: verified" $prohull verify solid.ply open.obj
expect 0 "repair in float32" $prohull repair open.obj --spacing 2% -o solid.stl --report solid.json
says out "repair in float32" "solid.stl: solid of"
says out "repair in float32" "to coordinates that the file keeps"
says solid.json "repair in float32" '"certified": true'
expect 0 "repair in float32: verified" $prohull verify solid.stl open.obj
printf 'OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -1\n3 0 1 2\n3 0 1 3\n3 0 1 4\n' >book.off
expect 0 "repair: a wrap" $prohull repair book.off --spacing 0.05 -o solid.off
says out "repair: a wrap" "bounds no solid:"
says out "repair: a wrap" "a wrap with a spacing of 0.05"
expect 0 "repair: a wrap verified" $prohull verify solid.off book.off
expect 2 "repair: no spacing" $prohull repair book.off --spacing 1mm -o solid.off

# --- what is not closed is repaired or wrapped; several budgets; bounds ---
expect 0 "several budgets" $prohull build rock.ply --faces 400,100 -o rock_{faces}.stl --report levels.json
for faces in 400 100; do expect 0 "level of $faces" $prohull verify rock_$faces.stl rock.ply; done
says levels.json "report: several hulls" '"hulls": ['
expect 2 "several hulls, one name" $prohull build rock.ply --faces 400,100 -o rock_x.stl
says err "several hulls, one name" "{faces}"
absent "rock_x.stl" "several hulls, one name"
expect 0 "void" $prohull build rock.ply --faces 4 --max-void 5 -o tight_enough.ply --report void.json
says out "void" "void 4."
expect 2 "negative void" $prohull build rock.ply --max-void -5 -o x.ply
expect 0 "an open mesh" $prohull build open.off --faces 100 -o capped.stl --hierarchy capped.phull --report capped.json
says out "an open mesh" "closed 1 opening, 1.414 across"
says out "an open mesh" "its inside with its openings closed"
says out "an open mesh" "its finest level is the input after repairs, not the input itself"
says capped.json "report: repaired" '"repair": "repaired"'
says capped.json "report: its source" '"source": "mesh"'
expect 0 "its hull, verified" $prohull verify capped.stl open.off
says out "its hull, verified" "not closed"
expect 0 "an open shell" $prohull build open.off --open-shells keep --faces 100 -o shell.stl --report shell.json
says out "an open shell" "covers every triangle"
says shell.json "report: its openings" '"open_shells": "keep"'
expect 0 "an open shell, verified" $prohull verify shell.stl open.off
expect 0 "NaN" $prohull build nan.off --faces 100 -o wrapped.off --report wrapped.json
says out "NaN" "dropped 3 faces with a corner that is not finite"
says out "NaN" "the triangles are flat: the hull is one of a thin solid around them"
says wrapped.json "report: its source" '"source": "convex-hull"'
expect 0 "NaN, verified" $prohull verify wrapped.off nan.off --finite-only
says out "NaN, verified" "3 faces of the original are not finite"
expect 0 "a sheet, by levels" $prohull build sheet.off --faces 200 -o wrapped.ply --hierarchy wrapped.phull
says out "a sheet, by levels" "its finest level is a wrap of the input, not the input itself"
expect 0 "its levels, verified" $prohull verify wrapped.phull sheet.off
expect 0 "its levels, described" $prohull info wrapped.phull --report wrapped.json
says out "its levels, described" " vertices, volume "
says out "its levels, described" ": a wrap of the input, not the input itself"
says_not out "its levels, described" "original"
printf 'OFF\n5 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n9 9 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >unused.off
expect 0 "a vertex that no face uses" $prohull build unused.off -o used.ply --hierarchy used.phull
expect 0 "a vertex that no face uses" $prohull info used.phull
says out "a vertex that no face uses" "original       4 faces, 4 vertices, volume 0.166666667"
says wrapped.json "report: finest level" '"finest_level": "wrap"'
expect 0 "a wrap of a closed mesh, by levels" $prohull build knot.ply --repair wrap --faces 200 -o wrapped.ply --hierarchy wrapped_knot.phull --report wrapped.json
says out "a wrap of a closed mesh, by levels" "certified: yes"
says wrapped.json "report: a wrap" '"repair": "wrap"'
says wrapped.json "report: its source" '"source": "wrap"'
expect 0 "its levels, verified" $prohull verify wrapped_knot.phull knot.ply
expect 1 "its levels, of another mesh" $prohull verify wrapped_knot.phull rock.ply
expect 0 "its levels, asked" $prohull query wrapped.phull --random 10
says out "its levels, asked" "faces of a wrap of the input"
expect 0 "its levels, extracted" $prohull lod wrapped.phull -o level.ply
says out "its levels, extracted" "the finest level of the file is a wrap of the input"
expect 0 "the input by levels" $prohull info rock.phull --report rock.json
says rock.json "report: the input by levels" '"finest_level": "input"'
$prohull sample pony -o pony.ply --faces 2000 >/dev/null
expect 0 "no overhang" $prohull build pony.ply --faces 4 --max-overhang 0 --keep-guards --repair none -o x.ply --report x.json
says x.json "report: overhang" '"max_overhang": 0.0'
says out "no overhang" "would make a spike"
expect 2 "a negative overhang" $prohull build pony.ply --max-overhang -1 -o x.ply

$prohull sample sphere -o sphere.obj --faces 5000 >/dev/null
awk '/^v / { printf "v %.9e %.9e %.9e\n", $2 * 3.4e38, $3 * 3.4e38, $4 * 3.4e38; next } { print }' sphere.obj >edge.obj
expect 0 "at the edge of float32" $prohull build edge.obj -o edge.stl --faces 100
says out "at the edge of float32" "certified: yes"

# An inside-out mesh is turned, and the turned one is what the hull encloses.
expect 0 "inside out" $prohull build inside_out.off -o tetrahedron.ply
says out "inside out" "inside out"
expect 0 "inside out, verified" $prohull verify tetrahedron.ply inside_out.off
expect 1 "a hull that is inside out" $prohull verify inside_out.off tetrahedron.ply
says out "a hull that is inside out" "all faces of the hull look inwards"
awk 'NR > 2 && NF == 3 { print $1 "e200", $2, $3; next } { print }' inside_out.off >far.off
expect 3 "coordinates that overflow" $prohull verify tetrahedron.ply far.off
says err "coordinates that overflow" "coordinates of the original reach 1e+200; beyond 1e+100 volumes overflow"
