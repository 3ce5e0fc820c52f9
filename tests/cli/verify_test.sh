# Drives `prohull verify` with originals that are no solid
make_rock
make_inner

# --- originals that are no solid ---
$prohull lod rock.phull --faces 20000000 -o finest.obj >/dev/null
sed '$d' finest.obj >open.obj
expect 0 "an open original" $prohull verify hull.stl open.obj --report verify.json
says out "an open original" "covers every triangle of open.obj, exactly"
says out "an open original" "the original is not closed"
says verify.json "report: an open original" '"original_closed": false'
expect 0 "an open original by a proof" $prohull verify rock.phull open.obj
says out "an open original by a proof" "covers every triangle of open.obj"
expect 0 "a closed original, its solid" $prohull verify hull.stl rock.ply --solid-only
says out "a closed original, its solid" "encloses the solid of rock.ply, exactly"
expect 0 "a proof, the solid" $prohull verify rock.phull rock.ply --solid-only
(cat open.obj && printf 'v 9 0 0\nf 1 2 -1\n') >stray.obj
for hull in hull.stl rock.phull; do
  expect 1 "a stray triangle" $prohull verify $hull stray.obj --report verify.json
  says out "a stray triangle" "1 face of stray.obj lies outside"
  says verify.json "report: a stray triangle" '"faces_outside": 1'
done
expect 3 "an inner hull of an open original" $prohull verify inner.obj open.obj --side inner
says err "an inner hull of an open original" "not closed"
expect 3 "an inner proof of an open original" $prohull verify inner.phull open.obj

# --- a gap whose digits are more than those that are told ---
cube() { printf "v %s\\n" "$1 $1 $1" "$1 $1 $2" "$1 $2 $1" "$1 $2 $2" "$2 $1 $1" "$2 $1 $2" "$2 $2 $1" "$2 $2 $2"
  printf 'f 1 2 4\nf 1 4 3\nf 5 7 8\nf 5 8 6\nf 1 5 6\nf 1 6 2\nf 3 4 8\nf 3 8 7\nf 1 3 7\nf 1 7 5\nf 2 6 8\nf 2 8 4\n'; }
cube 0 1 >cube.obj
cube -0.12345678951 2 >around.obj
expect 0 "a gap of many digits" $prohull verify around.obj cube.obj --gap 0.12345678951
says out "a gap of many digits" "keeps a gap of 0.123456789, exactly"
