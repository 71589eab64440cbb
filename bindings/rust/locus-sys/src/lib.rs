// Made from the public headers by bindings/rust/generate.py: run that, do not edit.
//! The C interface of liblocus as its headers declare it; they tell what everything means.
#![no_std]
#![allow(non_camel_case_types)]
extern crate std;
#[cfg(feature = "cold")]
mod cold;
mod constants;
mod functions;
mod structs;
#[cfg(feature = "cold")]
pub use cold::*;
pub use constants::*;
pub use functions::*;
pub use structs::*;
