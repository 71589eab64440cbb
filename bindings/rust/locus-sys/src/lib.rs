// Made from the public headers by bindings/rust/generate.py: run that, do not edit.
//! The C interface of liblocus as its headers declare it; they tell what everything means.
#![no_std]
#![allow(non_camel_case_types)]
extern crate std;
use std::os::raw::{c_char, c_void};
mod constants;
pub use constants::*;

macro_rules! zeroed {
    ($name:ident) => {
        impl Default for $name {
            /// All zero.
            fn default() -> Self {
                // SAFETY: numbers, pointers and optional functions, for which zero is a value.
                unsafe { core::mem::zeroed() }
            }
        }
    };
}

pub type locus_status = i32;

#[repr(C)]
pub struct locus_alerts {
    _opaque: [u8; 0],
    _marker: core::marker::PhantomData<(*mut u8, core::marker::PhantomPinned)>,
}

#[repr(C)]
pub struct locus_diagram {
    _opaque: [u8; 0],
    _marker: core::marker::PhantomData<(*mut u8, core::marker::PhantomPinned)>,
}

#[repr(C)]
pub struct locus_graph {
    _opaque: [u8; 0],
    _marker: core::marker::PhantomData<(*mut u8, core::marker::PhantomPinned)>,
}

#[repr(C)]
pub struct locus_pmq {
    _opaque: [u8; 0],
    _marker: core::marker::PhantomData<(*mut u8, core::marker::PhantomPinned)>,
}

#[repr(C)]
pub struct locus_pmq_selection {
    _opaque: [u8; 0],
    _marker: core::marker::PhantomData<(*mut u8, core::marker::PhantomPinned)>,
}

#[repr(C)]
pub struct locus_pmq_snapshot {
    _opaque: [u8; 0],
    _marker: core::marker::PhantomData<(*mut u8, core::marker::PhantomPinned)>,
}

#[repr(C)]
pub struct locus_weights {
    _opaque: [u8; 0],
    _marker: core::marker::PhantomData<(*mut u8, core::marker::PhantomPinned)>,
}

pub type locus_log_fn = Option<unsafe extern "C" fn(level: i32, text: *const c_char, user: *mut c_void)>;
pub type locus_progress_fn = Option<unsafe extern "C" fn(fraction: f64, user: *mut c_void) -> i32>;
pub type locus_remove_fn = Option<unsafe extern "C" fn(record: *const c_void, user: *mut c_void) -> i32>;
pub type locus_sink_fn = Option<unsafe extern "C" fn(record: *const c_void, user: *mut c_void) -> i32>;
pub type locus_filter_fn = Option<unsafe extern "C" fn(record: *const c_void, user: *mut c_void) -> i32>;
pub type locus_visit_fn = Option<unsafe extern "C" fn(record: *const c_void, user: *mut c_void) -> i32>;
pub type locus_group_fn = Option<unsafe extern "C" fn(record: *const c_void, user: *mut c_void) -> u64>;
pub type locus_record_weight_fn = Option<unsafe extern "C" fn(record: *const c_void, user: *mut c_void) -> f64>;
pub type locus_alert_fn = Option<unsafe extern "C" fn(alert: *const locus_alert, user: *mut c_void) -> i32>;
pub type locus_fence_fn = Option<unsafe extern "C" fn(fence: u64, record: *const c_void, user: *mut c_void) -> i32>;
pub type locus_weight_fn = Option<unsafe extern "C" fn(u: u64, v: u64, length: f64, user: *mut c_void) -> f64>;
pub type locus_bad_line_fn = Option<unsafe extern "C" fn(line: u64, reason: *const c_char, user: *mut c_void)>;

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_point32 {
    pub latitude: f64,
    pub longitude: f64,
    pub time: i64,
    pub device: u16,
    pub application: u16,
    pub language: u16,
    pub spare: u16,
}
zeroed!(locus_point32);

#[repr(C, packed(4))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_text156 {
    pub latitude: f32,
    pub longitude: f32,
    pub time: i64,
    pub text: [u8; 140],
}
zeroed!(locus_text156);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct locus_pmq_options {
    pub struct_size: u64,
    pub record: u32,
    pub layout: u32,
    pub index: u32,
    pub future: u32,
    pub horizon: i64,
    pub max_records: u64,
    pub max_bytes: u64,
    pub remove: locus_remove_fn,
    pub remove_user: *mut c_void,
    pub sink: locus_sink_fn,
    pub sink_user: *mut c_void,
    pub log: locus_log_fn,
    pub log_user: *mut c_void,
    pub segment_slots: u32,
    pub reserved0: u32,
    pub rho_leaf: f64,
    pub tau_leaf: f64,
    pub rho_root: f64,
    pub tau_root: f64,
    pub snapshot_bytes: u64,
}
zeroed!(locus_pmq_options);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_box {
    pub south: f64,
    pub west: f64,
    pub north: f64,
    pub east: f64,
}
zeroed!(locus_box);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_circle {
    pub latitude: f64,
    pub longitude: f64,
    pub radius: f64,
}
zeroed!(locus_circle);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_position {
    pub latitude: f64,
    pub longitude: f64,
}
zeroed!(locus_position);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct locus_polygon {
    pub vertices: *const locus_position,
    pub ring_sizes: *const u64,
    pub rings: u64,
}
zeroed!(locus_polygon);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct locus_pmq_query {
    pub struct_size: u64,
    pub region: u32,
    pub expired: u32,
    pub r#box: locus_box,
    pub time_from: i64,
    pub time_to: i64,
    pub filter: locus_filter_fn,
    pub filter_user: *mut c_void,
    pub snapshot: *const locus_pmq_snapshot,
    pub circle: locus_circle,
    pub polygon: locus_polygon,
    pub left: *mut u64,
}
zeroed!(locus_pmq_query);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_pmq_score {
    pub struct_size: u64,
    pub latitude: f64,
    pub longitude: f64,
    pub radius: f64,
    pub alpha: f64,
    pub period: i64,
}
zeroed!(locus_pmq_score);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_pmq_stats {
    pub struct_size: u64,
    pub records: u64,
    pub stored: u64,
    pub pending: u64,
    pub slots: u64,
    pub bytes: u64,
    pub inserted: u64,
    pub evicted: u64,
    pub erased: u64,
    pub batches: u64,
    pub moved: u64,
    pub rebalances: u64,
    pub grows: u64,
    pub shrinks: u64,
    pub longest_pause_ns: u64,
    pub density: f64,
    pub now: i64,
}
zeroed!(locus_pmq_stats);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_pmq_cursor {
    pub key: u64,
    pub passed: u64,
}
zeroed!(locus_pmq_cursor);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_pmq_group {
    pub value: u64,
    pub count: u64,
    pub newest: i64,
}
zeroed!(locus_pmq_group);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_key_range {
    pub first: u64,
    pub last: u64,
    pub inside: u32,
    pub reserved0: u32,
}
zeroed!(locus_key_range);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_alert {
    pub number: u64,
    pub kind: u32,
    pub zoom: u32,
    pub x: u32,
    pub y: u32,
    pub r#box: locus_box,
    pub time: i64,
    pub records: f64,
    pub rate: f64,
    pub expected: f64,
    pub share: f64,
}
zeroed!(locus_alert);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct locus_alerts_options {
    pub struct_size: u64,
    pub zoom_from: u32,
    pub zoom_to: u32,
    pub half_life: i64,
    pub history: i64,
    pub cool_down: i64,
    pub minimum: f64,
    pub factor: f64,
    pub rate: f64,
    pub share: f64,
    pub max_bytes: u64,
    pub alert: locus_alert_fn,
    pub alert_user: *mut c_void,
    pub fence: locus_fence_fn,
    pub fence_user: *mut c_void,
}
zeroed!(locus_alerts_options);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_alerts_stats {
    pub struct_size: u64,
    pub regions: u64,
    pub fences: u64,
    pub raised: u64,
    pub shown: u64,
    pub bytes: u64,
}
zeroed!(locus_alerts_stats);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_cold_options {
    pub struct_size: u64,
    pub record: u32,
    pub sync: u32,
    pub when_full: u32,
    pub reserved0: u32,
    pub queue_bytes: u64,
    pub batch_records: u64,
    pub delay: i64,
    pub run_records: u64,
    pub cache_bytes: u64,
    pub max_age: i64,
    pub max_bytes: u64,
}
zeroed!(locus_cold_options);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_cold_stats {
    pub struct_size: u64,
    pub received: u64,
    pub written: u64,
    pub removed: u64,
    pub stored: u64,
    pub runs: u64,
    pub queue_bytes: u64,
    pub file_bytes: u64,
    pub free_bytes: u64,
    pub transactions: u64,
    pub waits: u64,
    pub now: i64,
    pub failure: i32,
    pub reserved0: u32,
}
zeroed!(locus_cold_stats);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct locus_graph_options {
    pub struct_size: u64,
    pub dims: [u64; 3],
    pub spacing: [f64; 3],
    pub connectivity: u32,
    pub weight_rule: u32,
    pub material: u32,
    pub word_bits: u32,
    pub stiffness_exponent: f64,
    pub weight: locus_weight_fn,
    pub weight_user: *mut c_void,
    pub max_seeds: u64,
    pub scale: f64,
    pub precision: f64,
    pub material_min: f64,
    pub material_max: f64,
    pub threads: u32,
    pub backend: u32,
    pub simd: u32,
    pub reserved0: u32,
    pub log: locus_log_fn,
    pub log_user: *mut c_void,
}
zeroed!(locus_graph_options);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_graph_info {
    pub struct_size: u64,
    pub dims: [u64; 3],
    pub spacing: [f64; 3],
    pub passable: u64,
    pub bytes: u64,
    pub connectivity: u32,
    pub weight_rule: u32,
    pub word_bits: u32,
    pub label_bits: u32,
    pub scale: f64,
    pub max_exact: u64,
    pub max_distance: f64,
    pub weight_error: f64,
    pub smallest_step: f64,
    pub overflow_free: u32,
    pub threads: u32,
    pub backend: u32,
    pub simd: u32,
}
zeroed!(locus_graph_info);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_voxel_box {
    pub origin: [u64; 3],
    pub extent: [u64; 3],
}
zeroed!(locus_voxel_box);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_seed {
    pub x: u64,
    pub y: u64,
    pub z: u64,
    pub distance: f64,
    pub id: u32,
    pub fixed: u32,
}
zeroed!(locus_seed);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct locus_diagram_options {
    pub struct_size: u64,
    pub engine: u32,
    pub record_trace: u32,
    pub max_distance: f64,
    pub grain: [u32; 3],
    pub reserved0: u32,
    pub stream: *mut c_void,
}
zeroed!(locus_diagram_options);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_diagram_stats {
    pub struct_size: u64,
    pub reached: u64,
    pub seeds: u64,
    pub relaxations: u64,
    pub iterations: u64,
    pub max_exact: u64,
    pub max_distance: f64,
    pub seconds_import: f64,
    pub seconds_solve: f64,
    pub seconds_export: f64,
    pub bytes: u64,
    pub engine: u32,
    pub threads: u32,
    pub backend: u32,
    pub reserved0: u32,
}
zeroed!(locus_diagram_stats);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_cell_pair {
    pub a: u32,
    pub b: u32,
    pub edges: u64,
}
zeroed!(locus_cell_pair);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct locus_place_options {
    pub struct_size: u64,
    pub count: u64,
    pub first_id: u32,
    pub lloyd_iterations: u32,
    pub metric: u32,
    pub reserved0: u32,
    pub progress: locus_progress_fn,
    pub progress_user: *mut c_void,
}
zeroed!(locus_place_options);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_pmq_file_info {
    pub struct_size: u64,
    pub version: u32,
    pub record: u32,
    pub records: u64,
    pub bytes: u64,
    pub now: i64,
}
zeroed!(locus_pmq_file_info);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_pmq_log_options {
    pub struct_size: u64,
    pub sync: u32,
    pub redeliver: u32,
    pub sync_interval: i64,
    pub sync_bytes: u64,
    pub keep: u32,
    pub repair: u32,
}
zeroed!(locus_pmq_log_options);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_pmq_recovery {
    pub struct_size: u64,
    pub created: u32,
    pub skipped: u32,
    pub number: u64,
    pub saved: u64,
    pub changes: u64,
    pub inserted: u64,
    pub departed: u64,
    pub records: u64,
    pub cut: u64,
    pub now: i64,
}
zeroed!(locus_pmq_recovery);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_pmq_log_stats {
    pub struct_size: u64,
    pub number: u64,
    pub bytes: u64,
    pub unsynced: u64,
    pub changes: u64,
    pub syncs: u64,
    pub attached: u32,
    pub stopped: u32,
}
zeroed!(locus_pmq_log_stats);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct locus_weights_options {
    pub struct_size: u64,
    pub method: u32,
    pub max_per_row: u32,
    pub batch_bytes: u64,
    pub progress: locus_progress_fn,
    pub progress_user: *mut c_void,
}
zeroed!(locus_weights_options);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct locus_records_options {
    pub struct_size: u64,
    pub record: u32,
    pub format: u32,
    pub time_unit: u32,
    pub bad_lines: u32,
    pub separator: u32,
    pub max_line: u32,
    pub time_column: *const c_char,
    pub latitude_column: *const c_char,
    pub longitude_column: *const c_char,
    pub text_column: *const c_char,
    pub bad_line: locus_bad_line_fn,
    pub bad_line_user: *mut c_void,
}
zeroed!(locus_records_options);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_records_stats {
    pub struct_size: u64,
    pub records: u64,
    pub bad: u64,
    pub cut: u64,
    pub repaired: u64,
    pub line: u64,
    pub bytes_read: u64,
    pub bytes: u64,
}
zeroed!(locus_records_stats);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_volume_info {
    pub struct_size: u64,
    pub dims: [u64; 3],
    pub components: u64,
    pub spacing: [f64; 3],
    pub origin: [f64; 3],
    pub direction: [f64; 9],
    pub slope: f64,
    pub intercept: f64,
    pub r#type: u32,
    pub file_type: u32,
    pub format: u32,
    pub big_endian: u32,
}
zeroed!(locus_volume_info);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_volume_read_options {
    pub struct_size: u64,
    pub memory_limit: u64,
    pub numbers: u32,
    pub format: u32,
    pub allow_trailing: u32,
    pub raw_big_endian: u32,
    pub raw_type: u32,
    pub raw_interleaved: u32,
    pub raw_dims: [u64; 3],
    pub raw_components: u64,
    pub raw_offset: u64,
    pub raw_spacing: [f64; 3],
    pub raw_origin: [f64; 3],
}
zeroed!(locus_volume_read_options);

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct locus_volume_write_options {
    pub struct_size: u64,
    pub format: u32,
    pub compression: u32,
}
zeroed!(locus_volume_write_options);

extern "C" {
    pub fn locus_version() -> u32;
    pub fn locus_version_text() -> *const c_char;
    pub fn locus_status_name(status: locus_status) -> *const c_char;
    pub fn locus_last_error() -> *const c_char;
    pub fn locus_pmq_options_init(options: *mut locus_pmq_options, size: usize) -> locus_status;
    pub fn locus_pmq_query_init(query: *mut locus_pmq_query, size: usize) -> locus_status;
    pub fn locus_pmq_key(latitude: f64, longitude: f64, key: *mut u64) -> locus_status;
    pub fn locus_pmq_create(options: *const locus_pmq_options, pmq: *mut *mut locus_pmq) -> locus_status;
    pub fn locus_pmq_destroy(pmq: *mut locus_pmq);
    pub fn locus_pmq_insert(pmq: *mut locus_pmq, records: *const c_void, count: usize, now: i64) -> locus_status;
    pub fn locus_pmq_sweep(pmq: *mut locus_pmq, now: i64, evicted: *mut u64) -> locus_status;
    pub fn locus_pmq_erase(pmq: *mut locus_pmq, query: *const locus_pmq_query, erased: *mut u64) -> locus_status;
    pub fn locus_pmq_snapshot_create(pmq: *const locus_pmq, snapshot: *mut *mut locus_pmq_snapshot) -> locus_status;
    pub fn locus_pmq_snapshot_destroy(snapshot: *mut locus_pmq_snapshot);
    pub fn locus_pmq_count(pmq: *const locus_pmq, query: *const locus_pmq_query, count: *mut u64) -> locus_status;
    pub fn locus_pmq_read(pmq: *const locus_pmq, query: *const locus_pmq_query, records: *mut c_void, capacity: usize, count: *mut usize) -> locus_status;
    pub fn locus_pmq_visit(pmq: *const locus_pmq, query: *const locus_pmq_query, visit: locus_visit_fn, user: *mut c_void) -> locus_status;
    pub fn locus_pmq_read_page(pmq: *const locus_pmq, query: *const locus_pmq_query, cursor: *mut locus_pmq_cursor, records: *mut c_void, capacity: usize, count: *mut usize) -> locus_status;
    pub fn locus_pmq_groups(pmq: *const locus_pmq, query: *const locus_pmq_query, field: u32, group: locus_group_fn, user: *mut c_void, groups: *mut locus_pmq_group, capacity: usize, count: *mut usize) -> locus_status;
    pub fn locus_pmq_tile(pmq: *const locus_pmq, zoom: u32, x: u32, y: u32, log2_bins: u32, query: *const locus_pmq_query, bins: *mut u32, capacity: usize, total: *mut u64) -> locus_status;
    pub fn locus_pmq_weighted_tile(pmq: *const locus_pmq, zoom: u32, x: u32, y: u32, log2_bins: u32, query: *const locus_pmq_query, weight: locus_record_weight_fn, user: *mut c_void, bins: *mut f64, capacity: usize, total: *mut f64) -> locus_status;
    pub fn locus_pmq_score_init(score: *mut locus_pmq_score, size: usize) -> locus_status;
    pub fn locus_pmq_topk(pmq: *const locus_pmq, score: *const locus_pmq_score, query: *const locus_pmq_query, k: usize, records: *mut c_void, scores: *mut f64, count: *mut usize) -> locus_status;
    pub fn locus_pmq_nearest(pmq: *const locus_pmq, latitude: f64, longitude: f64, query: *const locus_pmq_query, k: usize, records: *mut c_void, distances: *mut f64, count: *mut usize) -> locus_status;
    pub fn locus_pmq_selection_create(query: *const locus_pmq_query, record: u32, selection: *mut *mut locus_pmq_selection) -> locus_status;
    pub fn locus_pmq_selection_destroy(selection: *mut locus_pmq_selection);
    pub fn locus_pmq_selection_ranges(selection: *const locus_pmq_selection, ranges: *mut locus_key_range, capacity: usize, count: *mut usize) -> locus_status;
    pub fn locus_pmq_selection_matches(selection: *const locus_pmq_selection, record: *const c_void, inside: u32, matches: *mut i32) -> locus_status;
    pub fn locus_pmq_get_stats(pmq: *const locus_pmq, stats: *mut locus_pmq_stats) -> locus_status;
    pub fn locus_pmq_check(pmq: *const locus_pmq) -> locus_status;
    pub fn locus_alerts_options_init(options: *mut locus_alerts_options, size: usize) -> locus_status;
    pub fn locus_alerts_create(pmq: *mut locus_pmq, options: *const locus_alerts_options, alerts: *mut *mut locus_alerts) -> locus_status;
    pub fn locus_alerts_destroy(alerts: *mut locus_alerts);
    pub fn locus_alerts_active(alerts: *const locus_alerts, active: *mut locus_alert, capacity: usize, count: *mut usize) -> locus_status;
    pub fn locus_alerts_add_fence(alerts: *mut locus_alerts, id: u64, query: *const locus_pmq_query) -> locus_status;
    pub fn locus_alerts_remove_fence(alerts: *mut locus_alerts, id: u64) -> locus_status;
    pub fn locus_alerts_get_stats(alerts: *const locus_alerts, stats: *mut locus_alerts_stats) -> locus_status;
    pub fn locus_graph_options_init(options: *mut locus_graph_options, size: usize) -> locus_status;
    pub fn locus_graph_create(options: *const locus_graph_options, material: *const f32, graph: *mut *mut locus_graph) -> locus_status;
    pub fn locus_graph_destroy(graph: *mut locus_graph);
    pub fn locus_graph_get_info(graph: *const locus_graph, info: *mut locus_graph_info) -> locus_status;
    pub fn locus_graph_set_box(graph: *mut locus_graph, r#box: *const locus_voxel_box, values: *const f32) -> locus_status;
    pub fn locus_graph_fill_box(graph: *mut locus_graph, r#box: *const locus_voxel_box, value: f32) -> locus_status;
    pub fn locus_graph_set_voxels(graph: *mut locus_graph, voxels: *const u64, values: *const f32, count: usize) -> locus_status;
    pub fn locus_graph_get_box(graph: *const locus_graph, r#box: *const locus_voxel_box, values: *mut f32, capacity: usize) -> locus_status;
    pub fn locus_graph_edge_weight(graph: *const locus_graph, u: u64, v: u64, steps: *mut u64) -> locus_status;
    pub fn locus_graph_cut_plane(graph: *mut locus_graph, point: *const f64, normal: *const f64, r#box: *const locus_voxel_box, edges: *mut u64) -> locus_status;
    pub fn locus_graph_cut_mesh(graph: *mut locus_graph, vertices: *const f64, vertex_count: usize, triangles: *const u32, triangle_count: usize, edges: *mut u64) -> locus_status;
    pub fn locus_graph_mend_box(graph: *mut locus_graph, r#box: *const locus_voxel_box, edges: *mut u64) -> locus_status;
    pub fn locus_diagram_options_init(options: *mut locus_diagram_options, size: usize) -> locus_status;
    pub fn locus_place_options_init(options: *mut locus_place_options, size: usize) -> locus_status;
    pub fn locus_diagram_create(graph: *mut locus_graph, options: *const locus_diagram_options, diagram: *mut *mut locus_diagram) -> locus_status;
    pub fn locus_diagram_destroy(diagram: *mut locus_diagram);
    pub fn locus_diagram_add_seeds(diagram: *mut locus_diagram, seeds: *const locus_seed, count: usize) -> locus_status;
    pub fn locus_diagram_remove_seeds(diagram: *mut locus_diagram, ids: *const u32, count: usize) -> locus_status;
    pub fn locus_diagram_move_seed(diagram: *mut locus_diagram, id: u32, x: u64, y: u64, z: u64) -> locus_status;
    pub fn locus_diagram_get_seeds(diagram: *const locus_diagram, seeds: *mut locus_seed, capacity: usize, count: *mut usize) -> locus_status;
    pub fn locus_diagram_place_seeds(diagram: *mut locus_diagram, options: *const locus_place_options) -> locus_status;
    pub fn locus_diagram_solve(diagram: *mut locus_diagram, progress: locus_progress_fn, user: *mut c_void) -> locus_status;
    pub fn locus_diagram_update(diagram: *mut locus_diagram, r#box: *mut locus_voxel_box, voxels: *mut u64, progress: locus_progress_fn, user: *mut c_void) -> locus_status;
    pub fn locus_diagram_labels(diagram: *const locus_diagram, r#box: *const locus_voxel_box, labels: *mut u32, capacity: usize) -> locus_status;
    pub fn locus_diagram_distances(diagram: *const locus_diagram, r#box: *const locus_voxel_box, distances: *mut f32, capacity: usize) -> locus_status;
    pub fn locus_diagram_distances_exact(diagram: *const locus_diagram, r#box: *const locus_voxel_box, distances: *mut u64, capacity: usize) -> locus_status;
    pub fn locus_diagram_path(diagram: *const locus_diagram, x: u64, y: u64, z: u64, voxels: *mut u64, capacity: usize, count: *mut usize) -> locus_status;
    pub fn locus_diagram_cell_sizes(diagram: *const locus_diagram, sizes: *mut u64, capacity: usize, count: *mut usize) -> locus_status;
    pub fn locus_diagram_cell_pairs(diagram: *const locus_diagram, pairs: *mut locus_cell_pair, capacity: usize, count: *mut usize) -> locus_status;
    pub fn locus_diagram_get_stats(diagram: *const locus_diagram, stats: *mut locus_diagram_stats) -> locus_status;
    pub fn locus_diagram_trace(diagram: *const locus_diagram, active: *mut u64, capacity: usize, count: *mut usize) -> locus_status;
    pub fn locus_pmq_save(pmq: *const locus_pmq, snapshot: *const locus_pmq_snapshot, path: *const c_char, progress: locus_progress_fn, user: *mut c_void) -> locus_status;
    pub fn locus_pmq_load(path: *const c_char, options: *const locus_pmq_options, progress: locus_progress_fn, user: *mut c_void, pmq: *mut *mut locus_pmq) -> locus_status;
    pub fn locus_pmq_get_file_info(path: *const c_char, info: *mut locus_pmq_file_info) -> locus_status;
    pub fn locus_pmq_log_options_init(options: *mut locus_pmq_log_options, size: usize) -> locus_status;
    pub fn locus_pmq_open(folder: *const c_char, options: *const locus_pmq_options, log_options: *const locus_pmq_log_options, progress: locus_progress_fn, user: *mut c_void, recovery: *mut locus_pmq_recovery, pmq: *mut *mut locus_pmq) -> locus_status;
    pub fn locus_pmq_attach(pmq: *mut locus_pmq, folder: *const c_char, log_options: *const locus_pmq_log_options, progress: locus_progress_fn, user: *mut c_void) -> locus_status;
    pub fn locus_pmq_checkpoint(pmq: *mut locus_pmq, progress: locus_progress_fn, user: *mut c_void) -> locus_status;
    pub fn locus_pmq_sync(pmq: *mut locus_pmq) -> locus_status;
    pub fn locus_pmq_get_log_stats(pmq: *const locus_pmq, stats: *mut locus_pmq_log_stats) -> locus_status;
    pub fn locus_weights_options_init(options: *mut locus_weights_options, size: usize) -> locus_status;
    pub fn locus_weights_create(diagram: *mut locus_diagram, options: *const locus_weights_options, r#box: *const locus_voxel_box, weights: *mut *mut locus_weights) -> locus_status;
    pub fn locus_weights_create_for(diagram: *mut locus_diagram, options: *const locus_weights_options, voxels: *const u64, count: usize, weights: *mut *mut locus_weights) -> locus_status;
    pub fn locus_weights_destroy(weights: *mut locus_weights);
    pub fn locus_weights_size(weights: *const locus_weights, rows: *mut u64, entries: *mut u64) -> locus_status;
    pub fn locus_weights_rows(weights: *const locus_weights, first: u64, count: u64, offsets: *mut u64, ids: *mut u32, values: *mut f32, capacity: usize, entries: *mut u64) -> locus_status;
    pub fn locus_weights_dense(weights: *const locus_weights, first: u64, count: u64, ids: *const u32, seeds: usize, dense: *mut f32, capacity: usize) -> locus_status;
    pub fn locus_weights_interpolate(weights: *const locus_weights, first: u64, count: u64, values: *const f32, components: u32, out: *mut f32, capacity: usize) -> locus_status;
    pub fn locus_weights_gradients(weights: *const locus_weights, first: u64, count: u64, id: u32, gradients: *mut f32, capacity: usize) -> locus_status;
    pub fn locus_weights_update(weights: *mut locus_weights, changed: *mut u64, capacity: usize, count: *mut usize) -> locus_status;
}
