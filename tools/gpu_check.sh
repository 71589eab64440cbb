#!/bin/bash
# tools/gpu_check.sh OUT: what only a machine with a GPU can show, run by `make gpu-check` after everything is built in OUT. Tests the
# CUDA backend against the heap engine, runs compute-sanitizer where it is there, benches, and writes
# tests/bench/results/<GPU>.jsonl (the rows) and .txt (the rest). QUICK=1: small sizes, into OUT.
# Without a GPU it runs what needs none, writes OUT/gpu-check.txt, says what was not run, and fails.
set -u
out=$1
program=$out/tests/gpu/cuda bench=$out/tests/bench_locus
results=tests/bench/results
failed=0
[ -z "${QUICK:-}" ] || results=$out
rounds() { [ -z "${QUICK:-}" ] && echo "$1" || echo "$2"; }
stage() { # title command...
    local title=$1 start=$SECONDS status=0
    shift
    "$@" >"$out/stage.txt" 2>&1 || status=$?
    { echo "== $title: $([ $status = 0 ] && echo passed || echo "FAILED, status $status"), $((SECONDS - start)) s"
      tail -n "${LINES_KEPT:-40}" "$out/stage.txt"; } | tee -a "$log"
    [ $status = 0 ] || failed=1
}
not_run() { echo "== $1: NOT RUN, $2" | tee -a "$log"; }

why=$(LD_LIBRARY_PATH=$out "$program" 1 GPU 2>&1) && gpu=yes || gpu=
name=gpu-check
if [ -n "$gpu" ]; then
    name=$(nvidia-smi --query-gpu=name --format=csv,noheader 2>/dev/null | head -n 1)
    name=$(tr -cs 'A-Za-z0-9' '-' <<<"${name:-unknown GPU}" | sed 's/-*$//')
else
    results=$out
fi
mkdir -p "$results"
log=$results/$name.txt
{ echo "commit $(git describe --always --dirty --exclude '*' 2>/dev/null || echo unknown)"
  nvidia-smi --query-gpu=name,driver_version,memory.total,clocks.max.sm --format=csv 2>/dev/null
  "${NVCC:-nvcc}" --version | tail -n 2; } | tee "$log"

# What needs no GPU: the bodies of the kernels on the host, and what the compiler says of them.
emulated() { env LD_LIBRARY_PATH="$out/tests/emulated" "$@"; }
stage "kernels on the emulated device against the heap engine" emulated "$program" "$(rounds 60 12)" GPU
stage "the same on a caller's stream" emulated EMULATED_STREAM=2 "$program" 12 stream
stage "a device that fails" emulated EMULATED_CALLS=40 "$program" 1 fails
stage "a library of another build" env LD_LIBRARY_PATH="$out/tests/stale" "$program" 1 'of another version than liblocus'
LINES_KEPT=200 stage "the compiler's report" tools/ptxas_table.sh "$out"/cuda/*.ptxas
LINES_KEPT=200 stage "rounds, visits and bytes, counted" "$out/tests/emulated/count" "$(rounds 64 32)"

sanitizer=$(command -v compute-sanitizer || ls /usr/local/cuda/bin/compute-sanitizer 2>/dev/null)
checks=(memcheck racecheck synccheck initcheck)
if [ -z "$gpu" ]; then
    for what in "random graphs on the GPU against the heap engine" "the same on a caller's stream" "${checks[@]/#/compute-sanitizer: }" benchmarks; do
        not_run "$what" "there is no GPU that Locus can use"
    done
    head -n 1 <<<"$why" | tee -a "$log"
    [ $failed = 0 ] && echo "gpu-check: all that needs no GPU passed" || echo "gpu-check: what needs no GPU failed too" >&2
    echo "gpu-check: incomplete, there is no GPU; see $log" >&2
    exit 1
fi

export LD_LIBRARY_PATH=$out
stage "random graphs on the GPU against the heap engine" "$program" "$(rounds 400 12)" GPU
stage "the same on a caller's stream" "$program" 12 stream
stage "benchmarks" "$bench" --out "$results/$name.jsonl" ${QUICK:+--quick} \
    --only '^(gpu\..*|thesis\.fig2\.15\..*)$'
for tool in "${checks[@]}"; do
    if [ -z "$sanitizer" ]; then
        not_run "compute-sanitizer: $tool" "compute-sanitizer is not there"
        continue
    fi
    more=() graphs=8
    [ "$tool" != memcheck ] || more=(--leak-check full)
    [ "$tool" != racecheck ] || graphs=2 # 20 times as slow as the others
    stage "compute-sanitizer: $tool" "$sanitizer" --tool "$tool" "${more[@]}" --error-exitcode 9 "$program" $graphs GPU
done
echo "results: $results/$name.jsonl and $log"
[ $failed = 0 ] || { echo "gpu-check: something failed, see $log" >&2; exit 1; }
echo "gpu-check: all passed"
