# Nothing is left half-written
make_rock

# --- nothing half-written ---
expect 3 "no such folder" $prohull build rock.ply --faces 500 -o nowhere/hull.ply
says err "no such folder" "nowhere/hull.ply"
if [ -d /proc/self ]; then
  expect 3 "a folder that takes no files" $prohull build rock.ply --faces 500 -o /proc/x.stl
  says err "a folder that takes no files" "choose another"
fi
if [ "$(id -u)" -ne 0 ]; then
  mkdir read_only && chmod a-w read_only
  expect 3 "read-only folder" $prohull build rock.ply --faces 500 -o read_only/hull.ply
  says err "read-only folder" "read_only/hull.ply"
fi
$prohull sample asteroid -o big.ply --faces $((400000 / divisor)) >/dev/null
most_ms=2000  # a second, and as much where tests run beside each other
# interrupted NAME SECONDS COMMAND...: Ctrl-C so long after it listens ends it soon, with 130, and leaves nothing named
# interrupted
interrupted() {
  name=$1 seconds=$2
  shift 2
  "$@" >out 2>err &
  # A background job of a shell ignores Ctrl-C, signal 2, unless the program asks for it, as prohull does.
  for _ in $(seq 200); do
    grep -q '^SigCgt:.*[2367abef]$' /proc/$!/status && break
    sleep 0.05
  done
  sleep "$seconds"
  since=$(date +%s%N)
  kill -INT $! 2>/dev/null
  wait $!
  code=$?
  took=$((($(date +%s%N) - since) / 1000000))
  checks=$((checks + 2))
  [ $took -lt $most_ms ] || fail "$name: answers after $took ms"
  [ $code -eq 130 ] || fail "$name: exit code $code, expected 130"
  says err "$name" "interrupted"
  absent "interrupted* .interrupted*" "$name"
}
interrupted "Ctrl-C" 0.3 $prohull build big.ply --faces 500 -o interrupted.ply --hierarchy interrupted.phull
interrupted "Ctrl-C of a query" 0.5 $prohull query big.ply --random 100000 --engine brute -o interrupted.csv
interrupted "Ctrl-C of a picture" 0.5 $prohull render big.ply --size 4000x3000 --samples 256 -o interrupted.png
interrupted "Ctrl-C of a tight hull" 0.5 $prohull build big.ply --faces 500 --tight -o interrupted.stl --report interrupted.json
interrupted "Ctrl-C of many queries" 0.5 $prohull query big.ply --random 5e7 --mode all -o interrupted.npz
interrupted "Ctrl-C of a verification" 0.5 $prohull verify rock.ply big.ply --report interrupted.json
interrupted "Ctrl-C of a sample" 0.5 $prohull sample knot --faces 3e7 -o interrupted.stl
interrupted "Ctrl-C of a wrap" 0.5 $prohull build big.ply --repair wrap --faces 5000 -o interrupted.stl
mkfifo pipe
sleep 60 >pipe &  # who writes into it and never ends
writer=$!
for command in "info pipe" "build pipe -o interrupted.stl" "lod pipe -o interrupted.stl" "verify pipe rock.ply" \
  "render pipe -o interrupted.png" "query rock.ply --rays pipe -o interrupted.csv"; do
  # shellcheck disable=SC2086
  interrupted "Ctrl-C of $command" 0.2 $prohull $command
done
kill $writer
