// Made from the public headers by bindings/rust/generate.py: run that, do not edit.
//! The functions of liblocus.
use crate::structs::*;
use std::os::raw::{c_char, c_void};

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
    pub fn locus_pmq_read(
        pmq: *const locus_pmq,
        query: *const locus_pmq_query,
        records: *mut c_void,
        capacity: usize,
        count: *mut usize,
    ) -> locus_status;
    pub fn locus_pmq_visit(
        pmq: *const locus_pmq,
        query: *const locus_pmq_query,
        visit: locus_visit_fn,
        user: *mut c_void,
    ) -> locus_status;
    pub fn locus_pmq_read_page(
        pmq: *const locus_pmq,
        query: *const locus_pmq_query,
        cursor: *mut locus_pmq_cursor,
        records: *mut c_void,
        capacity: usize,
        count: *mut usize,
    ) -> locus_status;
    pub fn locus_pmq_groups(
        pmq: *const locus_pmq,
        query: *const locus_pmq_query,
        field: u32,
        group: locus_group_fn,
        user: *mut c_void,
        groups: *mut locus_pmq_group,
        capacity: usize,
        count: *mut usize,
    ) -> locus_status;
    pub fn locus_pmq_tile(
        pmq: *const locus_pmq,
        zoom: u32,
        x: u32,
        y: u32,
        log2_bins: u32,
        query: *const locus_pmq_query,
        bins: *mut u32,
        capacity: usize,
        total: *mut u64,
    ) -> locus_status;
    pub fn locus_pmq_weighted_tile(
        pmq: *const locus_pmq,
        zoom: u32,
        x: u32,
        y: u32,
        log2_bins: u32,
        query: *const locus_pmq_query,
        weight: locus_record_weight_fn,
        user: *mut c_void,
        bins: *mut f64,
        capacity: usize,
        total: *mut f64,
    ) -> locus_status;
    pub fn locus_pmq_score_init(score: *mut locus_pmq_score, size: usize) -> locus_status;
    pub fn locus_pmq_topk(
        pmq: *const locus_pmq,
        score: *const locus_pmq_score,
        query: *const locus_pmq_query,
        k: usize,
        records: *mut c_void,
        scores: *mut f64,
        count: *mut usize,
    ) -> locus_status;
    pub fn locus_pmq_nearest(
        pmq: *const locus_pmq,
        latitude: f64,
        longitude: f64,
        query: *const locus_pmq_query,
        k: usize,
        records: *mut c_void,
        distances: *mut f64,
        count: *mut usize,
    ) -> locus_status;
    pub fn locus_pmq_selection_create(
        query: *const locus_pmq_query,
        record: u32,
        selection: *mut *mut locus_pmq_selection,
    ) -> locus_status;
    pub fn locus_pmq_selection_destroy(selection: *mut locus_pmq_selection);
    pub fn locus_pmq_selection_ranges(
        selection: *const locus_pmq_selection,
        ranges: *mut locus_key_range,
        capacity: usize,
        count: *mut usize,
    ) -> locus_status;
    pub fn locus_pmq_selection_matches(
        selection: *const locus_pmq_selection,
        record: *const c_void,
        inside: u32,
        matches: *mut i32,
    ) -> locus_status;
    pub fn locus_pmq_get_stats(pmq: *const locus_pmq, stats: *mut locus_pmq_stats) -> locus_status;
    pub fn locus_pmq_check(pmq: *const locus_pmq) -> locus_status;
    pub fn locus_alerts_options_init(options: *mut locus_alerts_options, size: usize) -> locus_status;
    pub fn locus_alerts_create(
        pmq: *mut locus_pmq,
        options: *const locus_alerts_options,
        alerts: *mut *mut locus_alerts,
    ) -> locus_status;
    pub fn locus_alerts_destroy(alerts: *mut locus_alerts);
    pub fn locus_alerts_active(
        alerts: *const locus_alerts,
        active: *mut locus_alert,
        capacity: usize,
        count: *mut usize,
    ) -> locus_status;
    pub fn locus_alerts_add_fence(alerts: *mut locus_alerts, id: u64, query: *const locus_pmq_query) -> locus_status;
    pub fn locus_alerts_remove_fence(alerts: *mut locus_alerts, id: u64) -> locus_status;
    pub fn locus_alerts_get_stats(alerts: *const locus_alerts, stats: *mut locus_alerts_stats) -> locus_status;
    pub fn locus_graph_options_init(options: *mut locus_graph_options, size: usize) -> locus_status;
    pub fn locus_graph_create(
        options: *const locus_graph_options,
        material: *const f32,
        graph: *mut *mut locus_graph,
    ) -> locus_status;
    pub fn locus_graph_destroy(graph: *mut locus_graph);
    pub fn locus_graph_get_info(graph: *const locus_graph, info: *mut locus_graph_info) -> locus_status;
    pub fn locus_graph_set_box(graph: *mut locus_graph, r#box: *const locus_voxel_box, values: *const f32) -> locus_status;
    pub fn locus_graph_fill_box(graph: *mut locus_graph, r#box: *const locus_voxel_box, value: f32) -> locus_status;
    pub fn locus_graph_set_voxels(graph: *mut locus_graph, voxels: *const u64, values: *const f32, count: usize) -> locus_status;
    pub fn locus_graph_get_box(
        graph: *const locus_graph,
        r#box: *const locus_voxel_box,
        values: *mut f32,
        capacity: usize,
    ) -> locus_status;
    pub fn locus_graph_edge_weight(graph: *const locus_graph, u: u64, v: u64, steps: *mut u64) -> locus_status;
    pub fn locus_graph_cut_plane(
        graph: *mut locus_graph,
        point: *const f64,
        normal: *const f64,
        r#box: *const locus_voxel_box,
        edges: *mut u64,
    ) -> locus_status;
    pub fn locus_graph_cut_mesh(
        graph: *mut locus_graph,
        vertices: *const f64,
        vertex_count: usize,
        triangles: *const u32,
        triangle_count: usize,
        edges: *mut u64,
    ) -> locus_status;
    pub fn locus_graph_mend_box(graph: *mut locus_graph, r#box: *const locus_voxel_box, edges: *mut u64) -> locus_status;
    pub fn locus_diagram_options_init(options: *mut locus_diagram_options, size: usize) -> locus_status;
    pub fn locus_place_options_init(options: *mut locus_place_options, size: usize) -> locus_status;
    pub fn locus_diagram_create(
        graph: *mut locus_graph,
        options: *const locus_diagram_options,
        diagram: *mut *mut locus_diagram,
    ) -> locus_status;
    pub fn locus_diagram_destroy(diagram: *mut locus_diagram);
    pub fn locus_diagram_add_seeds(diagram: *mut locus_diagram, seeds: *const locus_seed, count: usize) -> locus_status;
    pub fn locus_diagram_remove_seeds(diagram: *mut locus_diagram, ids: *const u32, count: usize) -> locus_status;
    pub fn locus_diagram_move_seed(diagram: *mut locus_diagram, id: u32, x: u64, y: u64, z: u64) -> locus_status;
    pub fn locus_diagram_get_seeds(
        diagram: *const locus_diagram,
        seeds: *mut locus_seed,
        capacity: usize,
        count: *mut usize,
    ) -> locus_status;
    pub fn locus_diagram_place_seeds(diagram: *mut locus_diagram, options: *const locus_place_options) -> locus_status;
    pub fn locus_diagram_solve(diagram: *mut locus_diagram, progress: locus_progress_fn, user: *mut c_void) -> locus_status;
    pub fn locus_diagram_update(
        diagram: *mut locus_diagram,
        r#box: *mut locus_voxel_box,
        voxels: *mut u64,
        progress: locus_progress_fn,
        user: *mut c_void,
    ) -> locus_status;
    pub fn locus_diagram_labels(
        diagram: *const locus_diagram,
        r#box: *const locus_voxel_box,
        labels: *mut u32,
        capacity: usize,
    ) -> locus_status;
    pub fn locus_diagram_distances(
        diagram: *const locus_diagram,
        r#box: *const locus_voxel_box,
        distances: *mut f32,
        capacity: usize,
    ) -> locus_status;
    pub fn locus_diagram_distances_exact(
        diagram: *const locus_diagram,
        r#box: *const locus_voxel_box,
        distances: *mut u64,
        capacity: usize,
    ) -> locus_status;
    pub fn locus_diagram_labels_on_device(
        diagram: *const locus_diagram,
        r#box: *const locus_voxel_box,
        labels: *mut c_void,
        capacity: usize,
    ) -> locus_status;
    pub fn locus_diagram_distances_on_device(
        diagram: *const locus_diagram,
        r#box: *const locus_voxel_box,
        distances: *mut c_void,
        capacity: usize,
    ) -> locus_status;
    pub fn locus_diagram_distances_exact_on_device(
        diagram: *const locus_diagram,
        r#box: *const locus_voxel_box,
        distances: *mut c_void,
        capacity: usize,
    ) -> locus_status;
    pub fn locus_diagram_path(
        diagram: *const locus_diagram,
        x: u64,
        y: u64,
        z: u64,
        voxels: *mut u64,
        capacity: usize,
        count: *mut usize,
    ) -> locus_status;
    pub fn locus_diagram_cell_sizes(
        diagram: *const locus_diagram,
        sizes: *mut u64,
        capacity: usize,
        count: *mut usize,
    ) -> locus_status;
    pub fn locus_diagram_cell_pairs(
        diagram: *const locus_diagram,
        pairs: *mut locus_cell_pair,
        capacity: usize,
        count: *mut usize,
    ) -> locus_status;
    pub fn locus_diagram_get_stats(diagram: *const locus_diagram, stats: *mut locus_diagram_stats) -> locus_status;
    pub fn locus_diagram_trace(
        diagram: *const locus_diagram,
        active: *mut u64,
        capacity: usize,
        count: *mut usize,
    ) -> locus_status;
    pub fn locus_pmq_save(
        pmq: *const locus_pmq,
        snapshot: *const locus_pmq_snapshot,
        path: *const c_char,
        progress: locus_progress_fn,
        user: *mut c_void,
    ) -> locus_status;
    pub fn locus_pmq_load(
        path: *const c_char,
        options: *const locus_pmq_options,
        progress: locus_progress_fn,
        user: *mut c_void,
        pmq: *mut *mut locus_pmq,
    ) -> locus_status;
    pub fn locus_pmq_get_file_info(path: *const c_char, info: *mut locus_pmq_file_info) -> locus_status;
    pub fn locus_pmq_log_options_init(options: *mut locus_pmq_log_options, size: usize) -> locus_status;
    pub fn locus_pmq_open(
        folder: *const c_char,
        options: *const locus_pmq_options,
        log_options: *const locus_pmq_log_options,
        progress: locus_progress_fn,
        user: *mut c_void,
        recovery: *mut locus_pmq_recovery,
        pmq: *mut *mut locus_pmq,
    ) -> locus_status;
    pub fn locus_pmq_attach(
        pmq: *mut locus_pmq,
        folder: *const c_char,
        log_options: *const locus_pmq_log_options,
        progress: locus_progress_fn,
        user: *mut c_void,
    ) -> locus_status;
    pub fn locus_pmq_checkpoint(pmq: *mut locus_pmq, progress: locus_progress_fn, user: *mut c_void) -> locus_status;
    pub fn locus_pmq_sync(pmq: *mut locus_pmq) -> locus_status;
    pub fn locus_pmq_get_log_stats(pmq: *const locus_pmq, stats: *mut locus_pmq_log_stats) -> locus_status;
    pub fn locus_weights_options_init(options: *mut locus_weights_options, size: usize) -> locus_status;
    pub fn locus_weights_create(
        diagram: *mut locus_diagram,
        options: *const locus_weights_options,
        r#box: *const locus_voxel_box,
        weights: *mut *mut locus_weights,
    ) -> locus_status;
    pub fn locus_weights_create_for(
        diagram: *mut locus_diagram,
        options: *const locus_weights_options,
        voxels: *const u64,
        count: usize,
        weights: *mut *mut locus_weights,
    ) -> locus_status;
    pub fn locus_weights_destroy(weights: *mut locus_weights);
    pub fn locus_weights_size(weights: *const locus_weights, rows: *mut u64, entries: *mut u64) -> locus_status;
    pub fn locus_weights_rows(
        weights: *const locus_weights,
        first: u64,
        count: u64,
        offsets: *mut u64,
        ids: *mut u32,
        values: *mut f32,
        capacity: usize,
        entries: *mut u64,
    ) -> locus_status;
    pub fn locus_weights_dense(
        weights: *const locus_weights,
        first: u64,
        count: u64,
        ids: *const u32,
        seeds: usize,
        dense: *mut f32,
        capacity: usize,
    ) -> locus_status;
    pub fn locus_weights_interpolate(
        weights: *const locus_weights,
        first: u64,
        count: u64,
        values: *const f32,
        components: u32,
        out: *mut f32,
        capacity: usize,
    ) -> locus_status;
    pub fn locus_weights_gradients(
        weights: *const locus_weights,
        first: u64,
        count: u64,
        id: u32,
        gradients: *mut f32,
        capacity: usize,
    ) -> locus_status;
    pub fn locus_weights_update(
        weights: *mut locus_weights,
        changed: *mut u64,
        capacity: usize,
        count: *mut usize,
    ) -> locus_status;
}
