// Made from the public headers by bindings/rust/generate.py: run that, do not edit.
//! The functions of liblocus_cold.
use crate::structs::*;
use std::os::raw::{c_char, c_void};

extern "C" {
    pub fn locus_cold_last_error() -> *const c_char;
    pub fn locus_cold_options_init(options: *mut locus_cold_options, size: usize) -> locus_status;
    pub fn locus_cold_open(path: *const c_char, options: *const locus_cold_options, cold: *mut *mut locus_cold) -> locus_status;
    pub fn locus_cold_close(cold: *mut locus_cold);
    pub fn locus_cold_attach(cold: *mut locus_cold, options: *mut locus_pmq_options) -> locus_status;
    pub fn locus_cold_count(
        cold: *mut locus_cold,
        pmq: *const locus_pmq,
        query: *const locus_pmq_query,
        count: *mut u64,
    ) -> locus_status;
    pub fn locus_cold_read(
        cold: *mut locus_cold,
        pmq: *const locus_pmq,
        query: *const locus_pmq_query,
        records: *mut c_void,
        capacity: usize,
        count: *mut usize,
    ) -> locus_status;
    pub fn locus_cold_visit(
        cold: *mut locus_cold,
        pmq: *const locus_pmq,
        query: *const locus_pmq_query,
        visit: locus_visit_fn,
        user: *mut c_void,
    ) -> locus_status;
    pub fn locus_cold_flush(cold: *mut locus_cold) -> locus_status;
    pub fn locus_cold_sweep(cold: *mut locus_cold, now: i64) -> locus_status;
    pub fn locus_cold_rewind(cold: *mut locus_cold, received: u64) -> locus_status;
    pub fn locus_cold_get_stats(cold: *const locus_cold, stats: *mut locus_cold_stats) -> locus_status;
    pub fn locus_cold_check(cold: *mut locus_cold) -> locus_status;
}
