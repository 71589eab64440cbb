//! Locus for Rust: voxel graphs, their Voronoi diagrams and interpolation weights, and the live window of a geo-located
//! stream.
//!
//! Each method is the C function of its name; the headers in `include/locus` tell units, ranges and errors.
//!
//! - A failed call is an [`Error`] with the library's text.
//! - Callbacks are closures. What one panics with goes on when the call it belongs to has returned.
//! - Calls that exclude each other, from two threads or from within a callback, are [`Error::Busy`].
//! - The feature `cold` adds `Cold`, the tier of a store in an SQLite database, and links `liblocus_cold`.
//! - Volumes are dense, x fastest; times are microseconds since 1970-01-01 UTC.
#![warn(missing_docs)]

pub use locus_sys as sys;

#[macro_use]
mod macros;
mod alerts;
mod callback;
#[cfg(feature = "cold")]
mod cold;
mod diagram;
mod error;
mod graph;
mod query;
mod storage;
mod store;
mod weights;

pub use alerts::*;
pub use callback::Log;
#[cfg(feature = "cold")]
pub use cold::*;
pub use diagram::*;
pub use error::{version, version_text, Error, Result};
pub use graph::*;
pub use query::*;
pub use storage::*;
pub use store::{Future, Index, Layout, Record, Snapshot, Store, StoreOptions, StoreStats};
pub use weights::{Method, Rows, Weights, WeightsOptions};

#[cfg(all(doctest, feature = "cold"))]
#[doc = include_str!("../../README.md")]
pub struct Readme;
