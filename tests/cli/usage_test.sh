# Wrong usage, which ends with 2, and help
make_rock

# --- wrong usage is 2 ---
expect 2 "no command" $prohull
says err "no command" "Commands:"
expect 2 "unknown command" $prohull biuld rock.ply -o x.ply
says err "unknown command" "unknown command 'biuld'; did you mean 'build'?"
expect 2 "unknown option" $prohull build rock.ply -o x.ply --face 10
says err "unknown option" "unknown option '--face' of build; did you mean '--faces'?"
expect 2 "a letter" $prohull build rock.ply -o x.ply -f 10
says err "a letter" "unknown option '-f' of build; did you mean '--faces'?"
expect 2 "a letter of nothing" $prohull build rock.ply -o x.ply -z
is "a letter of nothing: nothing is suggested" sh -c "! grep -q 'did you mean' err"
expect 2 "an option with =" $prohull build rock.ply -o x.ply --max-viod=10
says err "an option with =" "unknown option '--max-viod' of build; did you mean '--max-void'?"
expect 2 "an option before the command" $prohull --quiet info rock.ply
says err "an option before the command" "unknown option '--quiet'; options go behind the command"
expect 2 "nothing like it" $prohull frobnicate
says err "nothing like it" "unknown command 'frobnicate'"
checks=$((checks + 1))
grep -q "did you mean" err && fail "nothing like it: something is suggested"
expect 2 "one argument too many" $prohull info rock.ply hull.stl
says err "one argument too many" "'hull.stl' is one argument too many for info"
expect 2 "no mesh" $prohull build -o x.ply
says err "no mesh" "IN is missing"
expect 2 "a choice" $prohull build rock.ply -o x.ply --side iner
says err "a choice" "--side must be outer or inner, not 'iner'; did you mean 'inner'?"
expect 2 "a value left out" $prohull build rock.ply -o x.ply --faces
says err "a value left out" "--faces needs a value behind it"
expect 2 "no output" $prohull build rock.ply
expect 2 "too few faces" $prohull build rock.ply --faces 3 -o x.ply
says err "too few faces" "--faces must be at least 4, not 3"
expect 2 "too great a seed" $prohull build rock.ply -o x.ply --seed 1e20
says err "too great a seed" "--seed must be at most"
expect 2 "no number" $prohull build rock.ply --faces many -o x.ply
says err "no number" "--faces must be a whole number, not 'many'"
expect 2 "half a face" $prohull build rock.ply --faces 100.5 -o x.ply
says err "half a face" "--faces must be a whole number, not 100.5"
$prohull sample bracket --faces 500 -o bracket.ply >/dev/null
expect 0 "bounds ask for more faces" $prohull build bracket.ply --faces 50 --max-distance 0.001 -o x.ply --report x.json
says_not out "bounds ask for more faces" "no hull of"
says x.json "bounds ask for more faces" '"within_bounds": true'
says x.json "bounds ask for more faces" '"stopped": "bounds_reached"'
expect 2 "two numbers of faces" $prohull build rock.ply --faces 100 --faces 50 -o x.ply
says err "two numbers of faces" "x.ply: --faces asks for 2 hulls, which need names of their own; put {faces} where the number of faces goes, as in x_{faces}.ply"
expect 2 "two hulls for standard output" $prohull build rock.ply --faces 100,50 -o - --out-format off
says err "two hulls for standard output" "standard output: --faces asks for 2 hulls"
says err "two hulls for standard output" "as in hull_{faces}.off"
expect 0 "a void in per cent" $prohull build rock.ply --faces 50 --max-void 40% -o x.ply --report x.json
says x.json "a void in per cent" '"max_void_percent": 40.0'
expect 2 "a void of no number" $prohull build rock.ply --faces 50 --max-void % -o x.ply
says err "a void of no number" "--max-void must be a number, not '%'"
expect 2 "a path and a workspace" $prohull sweep rock.ply path.csv --workspace -o x.ply
says err "a path and a workspace" "PATH cannot be used together with --workspace"
expect 2 "no distance" $prohull build rock.ply --max-distance 0 -o x.ply
says err "no distance" "--max-distance must be greater than 0, not 0"
expect 2 "too many degrees" $prohull build rock.ply --max-normal-deviation 91 -o x.ply
says err "too many degrees" "--max-normal-deviation must be between 0 and 90, not 91"
expect 0 "scientific notation" $prohull build rock.ply --faces 1e3,500 -o x_{faces}.ply --seed 18446744073709551615
says out "scientific notation" "x_1000.ply: outer hull of 1,000 faces"
rm x_*.ply
expect 2 "negative faces" $prohull build rock.ply --faces -5 -o x.ply
expect 2 "hierarchy over the input" $prohull build rock.phull -o x.ply --hierarchy rock.phull
says err "hierarchy over the input" "named twice"
expect 2 "output in .gz" $prohull build rock.ply -o x.ply.gz
expect 2 "a side by number" $prohull build rock.ply -o x.ply --side 1
says err "a side by number" "outer"
expect 2 "a picture of another kind" $prohull render rock.ply -o picture.jpg
says err "a picture of another kind" ".png"
for size in 0x10 10 10x 10x10x10 99999x10 ax10; do
  expect 2 "size $size" $prohull render rock.ply -o wrong.png --size $size
done
expect 2 "no colour" $prohull render rock.ply -o wrong.png --color mauve
says err "no colour" "orange"
expect 2 "no background" $prohull render rock.ply -o wrong.png --background none
expect 2 "no level" $prohull render rock.phull -o wrong.png --faces many
expect 0 "a number of faces with an exponent" $prohull render rock.phull -o level.png --faces 1e9 --size 64x64
expect 2 "levels of a mesh" $prohull render rock.ply -o wrong.png --faces 100
expect 2 "two zooms, three panels" $prohull render rock.ply rock.ply rock.ply -o wrong.png --zoom 1 --zoom 2
says err "two zooms, three panels" "--zoom is given 2 times"
expect 2 "no samples" $prohull render rock.ply -o wrong.png --samples 0
expect 2 "refined along nothing" $prohull render rock.phull -o wrong.png --refine
expect 2 "a mesh refined" $prohull render rock.ply -o wrong.png --refine --segment 3,0,0,-3,0,0
says err "a mesh refined" ".phull"
for segment in 1,2,3 1,2,3,4,5,6,7 1,2,3,4,5,nan 1,2,3,1,2,3 a,b,c,d,e,f; do
  expect 2 "segment $segment" $prohull render rock.ply -o wrong.png --segment $segment
done
expect 2 "more panels than pixels" $prohull render rock.ply rock.ply rock.ply -o wrong.png --size 2x2
expect 2 "picture and report in one" $prohull render rock.ply -o wrong.png --report wrong.png
absent "wrong.png" "wrong usage"
expect 2 "unknown sample" $prohull sample cow -o x.ply
says err "unknown sample" "sphere"
expect 0 "help" $prohull build --help
says out "help has examples" "prohull build"
cp out build_help
expect 0 "help of a command" $prohull help build
same "help of a command" out build_help
says out "help of a command: there is more" "\`prohull help build --all\` shows"
expect 0 "help of the program" $prohull help
says out "help of the program" "Commands:"
expect 2 "help of no command" $prohull help biuld
says err "help of no command" "did you mean 'build'?"
expect 0 "exclusions" env COLUMNS=1000 $prohull help build --all
says out "help --all: groups" "More for research:"
is "exclusions are told once" sh -c "! grep -q 'Not with.*Not with' out"
for command in "" build verify info lod query contains distance collide convex render sample completion manual help; do
  for columns in 40 80 132; do
    expect 0 "help in $columns columns" env COLUMNS=$columns $prohull help $command
    checks=$((checks + 1))  # names of options, lists of choices and examples are as long as they are
    grep -vE '^  +(prohull|curl|-)|[^ ]\|' out | awk -v most=$columns 'length > most { exit 1 }' ||
      fail "help $command: wider than $columns columns"
    checks=$((checks + 1))
    grep -qE '\b(TEXT|UINT|INT|FLOAT|BOOLEAN|ENUM)\b' out && fail "help $command: a type of C++"
  done
  [ -z "$command" ] && continue
  says out "help $command has examples" "Examples:"
  says out "help $command" "--quiet"
  says out "help $command" "--verbose"
done
