#!/bin/bash
# tests/bindings/rust.sh LIBRARY_FOLDER TARGET_FOLDER: the Rust crates' form, tests and doctests, their structs against C, the tour, which
# is built without features and needs liblocus alone; off the network.
set -euo pipefail
cd "$(dirname "$0")/../.."
export LOCUS_LIB_DIR=$1 LD_LIBRARY_PATH=$1 CARGO_TARGET_DIR=$2 CARGO_NET_OFFLINE=true
bindings/rust/generate.py --check
manifest=(--manifest-path bindings/rust/Cargo.toml --quiet)
if command -v rustfmt >/dev/null; then cargo fmt "${manifest[@]}" -p locus-sys -p locus --check; else echo "form: skipped, there is no rustfmt"; fi
cargo test "${manifest[@]}" --all-features
tests/bindings/layout.sh cargo run "${manifest[@]}" -p locus-sys --example layout
cargo run "${manifest[@]}" -p locus --example tour
if readelf -d "$CARGO_TARGET_DIR/debug/examples/tour" | grep liblocus_cold; then echo "the tour needs liblocus_cold"; exit 1; fi
