# How much commands print, and where
make_rock
make_knot
make_unit
make_rays

# --- how much is told, and where ---
$prohull build rock.ply --faces 500 -o plain.stl >/dev/null
expect 0 "quiet" $prohull build rock.ply --faces 500 -o quiet.stl --quiet
checks=$((checks + 1))
[ -s out ] || [ -s err ] && fail "quiet: something is printed"
same "quiet" quiet.stl plain.stl
expect 3 "quiet, but wrong" $prohull info nowhere.ply --quiet
says err "quiet, but wrong" "nowhere.ply"
for command in "build rock.ply --faces 500 -o x.stl" "verify hull.stl rock.ply" "info rock.ply" "lod rock.phull -o x.stl" \
  "query rock.ply --random 10" "render rock.ply --size 16x16 -o x.png" "sample torus -o x.stl"; do
  expect 0 "quiet $command" $prohull $command -q
  checks=$((checks + 1))
  [ -s out ] && fail "quiet $command: something is printed"
  expect 0 "$command" $prohull $command
  lines=$(wc -l <out)
  expect 0 "verbose $command" $prohull $command -v
  checks=$((checks + 1))
  [ "$(wc -l <out)" -gt "$lines" ] || fail "verbose $command: nothing more is printed"
done
expect 2 "quiet and verbose" $prohull info rock.ply -q -v
expect 0 "verbose" $prohull build knot.ply --faces 100 -o x.ply --verbose
says out "verbose: refusals in words" "would make a triangle too thin"

# --- standard input and output ---
$prohull lod rock.phull --faces 20000000 -o finest.obj >/dev/null
$prohull render rock.ply -o rock.png --size 160x120 >/dev/null
printf 'ray,t,face,x,y,z,entering\n0,0.25,0,0.25,0.25,0,1\n' >rays_expected.csv
expect 0 "through pipes" sh -c "$prohull build - --faces 500 -o - --out-format stl <rock.ply >piped.stl"
says err "through pipes: the summary" "standard output: outer hull of 500 faces"
same "through pipes" piped.stl plain.stl
expect 3 "an input of no known format" sh -c "echo hello | $prohull info -"
says err "an input of no known format" "give it the suffix of its format; --in-format names its format"
expect 0 "an input without magic bytes" sh -c "$prohull info - --in-format obj <finest.obj"
says out "an input without magic bytes" "standard input"
expect 0 "a mesh by another name" $prohull lod rock.phull -o level.tmp --out-format stl
expect 0 "a chain of pipes" sh -c "$prohull sample torus --faces 500 -o - --out-format off | $prohull query - --random 10 \
  -o - --out-format csv >piped.csv"
says piped.csv "a chain of pipes" "segment,t,face"
expect 0 "rays from a pipe" sh -c "$prohull query unit.off --rays - -o - --out-format csv <rays.csv >piped.csv"
same "rays from a pipe" piped.csv rays_expected.csv
expect 0 "a proof through pipes" sh -c "$prohull build rock.ply --faces 500 -o x.ply --hierarchy - | $prohull verify - rock.ply"
says out "a proof through pipes" "every level of standard input encloses rock.ply"
expect 0 "a picture through pipes" sh -c "$prohull render - --size 160x120 -o - <rock.ply >piped.png"
same "a picture through pipes" piped.png rock.png
expect 0 "a report to standard output" sh -c "$prohull info rock.ply --report - >piped.json"
says piped.json "a report to standard output" '"version":'
says err "a report to standard output: the summary" "closed 2-manifold"
expect 2 "an output without a format" $prohull build rock.ply -o -
says err "an output without a format" "add --out-format ply, obj, off, stl or glb"
expect 2 "name and format disagree" $prohull build rock.ply -o x.stl --out-format ply
expect 2 "two files in one output" $prohull build rock.ply -o - --out-format ply --report -
expect 2 "two files from one input" $prohull verify - -
for outputs in "build rock.ply -o x.txt" "build rock.ply -o x.ply --hierarchy x.ply2" "lod rock.phull -o x.txt" \
  "sample torus -o x" "render rock.ply -o x.jpg" "query rock.ply --random 10 -o x.npy" \
  "query rock.ply --random 10 --write-segments x.npz"; do
  expect 2 "unsuitable: $outputs" $prohull $outputs
  says err "unsuitable: $outputs" "; name the file ."
done
