// Made from the public headers by bindings/rust/generate.py: run that, do not edit.
//! The types, those of liblocus_io and liblocus_cold too.
use std::os::raw::{c_char, c_void};

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
pub struct locus_cold {
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
    pub order: u32,
    pub reserved0: u32,
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
    pub on_device: u32,
    pub reserved1: u32,
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
