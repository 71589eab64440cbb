#!/bin/bash
# tests/bindings/rust.sh LIBRARY_FOLDER TARGET_FOLDER: the Rust crates' tests and doctests, their structs against C, the tour; off the network.
set -euo pipefail
cd "$(dirname "$0")/../.."
export LOCUS_LIB_DIR=$1 LD_LIBRARY_PATH=$1 CARGO_TARGET_DIR=$2 CARGO_NET_OFFLINE=true
bindings/rust/generate.py --check
manifest=(--manifest-path bindings/rust/Cargo.toml --quiet)
cargo test "${manifest[@]}"
tests/bindings/layout.sh cargo run "${manifest[@]}" -p locus-sys --example layout
cargo run "${manifest[@]}" -p locus --example tour
