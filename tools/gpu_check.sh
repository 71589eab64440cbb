#!/bin/bash
# tools/gpu_check.sh OUT: what only a machine with a GPU can show, run by `make gpu-check` after everything is built in OUT. Tests the
# CUDA backend against the heap engine, runs compute-sanitizer where it is there, benches, and writes
# tests/bench/results/<GPU>.jsonl (the rows) and .txt (the rest). QUICK=1: small sizes, into OUT.
set -u
out=$1
program=$out/tests/api/cuda bench=$out/tests/bench_locus
export LD_LIBRARY_PATH=$out
fail() { echo "gpu-check: $*" >&2; exit 1; }

"$program" 1 GPU >"$out/gpu.txt" 2>&1 || { cat "$out/gpu.txt" >&2; fail "there is no GPU that Locus can use, or it fails on it"; }
name=$(nvidia-smi --query-gpu=name --format=csv,noheader 2>/dev/null | head -n 1)
name=$(tr -cs 'A-Za-z0-9' '-' <<<"${name:-unknown GPU}" | sed 's/-*$//')
results=tests/bench/results
[ -z "${QUICK:-}" ] || results=$out
mkdir -p "$results"
log=$results/$name.txt
failed=0
stage() { # title command...
    local title=$1 start=$SECONDS status=0
    shift
    "$@" >"$out/stage.txt" 2>&1 || status=$?
    { echo "== $title: $([ $status = 0 ] && echo passed || echo "FAILED, status $status"), $((SECONDS - start)) s"
      tail -n 40 "$out/stage.txt"; } | tee -a "$log"
    [ $status = 0 ] || failed=1
}

{ echo "commit $(git describe --always --dirty --exclude '*' 2>/dev/null || echo unknown)"
  nvidia-smi --query-gpu=name,driver_version,memory.total,clocks.max.sm --format=csv 2>/dev/null
  "${NVCC:-nvcc}" --version | tail -n 2; } >"$log"
stage "random graphs against the heap engine" "$program" "$([ -z "${QUICK:-}" ] && echo 400 || echo 12)" GPU
sanitizer=$(command -v compute-sanitizer || ls /usr/local/cuda/bin/compute-sanitizer 2>/dev/null)
if [ -n "$sanitizer" ]; then
    stage "memcheck" "$sanitizer" --tool memcheck --leak-check full --error-exitcode 9 "$program" 12 GPU
    stage "racecheck" "$sanitizer" --tool racecheck --error-exitcode 9 "$program" 8 GPU
    stage "synccheck" "$sanitizer" --tool synccheck --error-exitcode 9 "$program" 8 GPU
else
    echo "== compute-sanitizer is not there: left out" | tee -a "$log"
fi
stage "benchmarks" "$bench" --out "$results/$name.jsonl" ${QUICK:+--quick} \
    --only '^(gpu\..*|thesis\.table2\.1\..*|thesis\.fig2\.15\..*)$'
echo "results: $results/$name.jsonl and $log"
[ $failed = 0 ] || fail "see $log"
