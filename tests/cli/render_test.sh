# Drives `prohull render`
make_rock

# --- pictures ---
# is_png FILE NAME WIDTH HEIGHT, in hexadecimal: the signature, and the first chunk with the size
is_png() {
  checks=$((checks + 1))
  [ "$(head -c 24 "$1" | od -A n -t x1 | tr -d ' \n')" = "89504e470d0a1a0a0000000d49484452$3$4" ] || fail "$2: no such PNG"
}
expect 0 "render" $prohull render rock.ply -o rock.png --size 160x120 --report render.json
says out "render tells what it drew" "rock.png: 160 x 120, $((20 / divisor)),"
says render.json "report: size" '"width": 160'
is_png rock.png "render" 000000a0 00000078
for threads in 1 2; do
  expect 0 "hull over mesh" $prohull render hull.stl --over rock.ply --wireframe --ground --threads $threads \
    --size 160x120 -o over$threads.png
done
checks=$((checks + 1))
cmp -s over1.png over2.png || fail "the same picture by any number of threads"
expect 0 "levels side by side" $prohull render rock.phull --faces original,2000 --size 200x100 -o levels.png
says out "levels side by side" " + 2,000 faces"
is_png levels.png "levels side by side" 000000c8 00000064
says_not out "levels side by side" "coarsest"
expect 0 "coarser than all levels" $prohull render rock.phull --faces 4 --size 200x100 -o coarse.png
says out "coarser than all levels" "rock.phull: no level has 4 faces or fewer; the coarsest one, of "
expect 0 "a palette" $prohull render rock.phull --faces original,2000 --size 200x100 --palette -o small.png
is_png small.png "a palette" 000000c8 00000064
checks=$((checks + 1))
[ "$(wc -c <small.png)" -lt "$(wc -c <levels.png)" ] || fail "a palette makes smaller files"
expect 0 "split" $prohull render rock.phull --split original --size 160x120 --background transparent -o split.png
expect 0 "refined along a segment" $prohull render rock.phull --segment 3,0.1,0.2,-3,0.1,0.2 --refine --zoom 2 \
  --center 1,0,0 --size 160x120 -o refined.png --report refined.json
says refined.json "crossings" '"found": ['
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 1\n3 0 1 2\n' >triangle.off
expect 0 "an open mesh" $prohull render triangle.off --size 16x16 -o open.png
$prohull sample gripper -o drawn >/dev/null
expect 0 "a robot beside a mesh" $prohull render drawn/gripper.urdf rock.ply --color orange --size 160x80 -o robot.png \
  --report robot.json
is_png robot.png "a robot beside a mesh" 000000a0 00000050
says robot.json "a robot within its collision geometry" '"faces_inside": '
expect 0 "over a robot" $prohull render rock.ply --over drawn/gripper.urdf --size 160x80 -o robot.png --report robot.json
says robot.json "over a robot" '"faces_inside": '
expect 3 "a robot that is none" sh -c "echo '<a/>' >none.urdf; $prohull render none.urdf -o none.png"
for option in "--over rock.ply" "--split rock.ply" "--refine --segment 3,0,0,-3,0,0"; do
  expect 2 "a robot $option" $prohull render drawn/gripper.urdf $option -o none.png
  says err "a robot $option" "within its own collision geometry"
done
expect 2 "levels of a robot" $prohull render drawn/gripper.urdf --faces 100 -o none.png
says err "levels of a robot" ".phull"
absent "none.png" "no picture of a robot"
expect 0 "from a pipe" sh -c "cat rock.ply | $prohull render /dev/stdin --size 16x16 -o pipe.png"
