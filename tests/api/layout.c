/* The size of every public struct and the offset of every field, on 64-bit machines: the same in every release, but for
 * what is appended to a struct that begins with its size. */
#include "check.h"

#include <locus/cold.h>
#include <locus/locus.h>
#include <locus/records.h>
#include <locus/volume.h>

#include <stddef.h>

#define SIZE(type, bytes) CHECK(sizeof(type) == (bytes))
#define FIELD(type, field, bytes) CHECK(offsetof(type, field) == (bytes))

int main(void) {
    SIZE(locus_seed, 40);
    FIELD(locus_seed, x, 0);
    FIELD(locus_seed, y, 8);
    FIELD(locus_seed, z, 16);
    FIELD(locus_seed, distance, 24);
    FIELD(locus_seed, id, 32);
    FIELD(locus_seed, fixed, 36);

    SIZE(locus_diagram_options, 56);
    FIELD(locus_diagram_options, struct_size, 0);
    FIELD(locus_diagram_options, engine, 8);
    FIELD(locus_diagram_options, record_trace, 12);
    FIELD(locus_diagram_options, max_distance, 16);
    FIELD(locus_diagram_options, grain, 24);
    FIELD(locus_diagram_options, reserved0, 36);
    FIELD(locus_diagram_options, stream, 40);
    FIELD(locus_diagram_options, on_device, 48);
    FIELD(locus_diagram_options, reserved1, 52);

    SIZE(locus_diagram_stats, 104);
    FIELD(locus_diagram_stats, struct_size, 0);
    FIELD(locus_diagram_stats, reached, 8);
    FIELD(locus_diagram_stats, seeds, 16);
    FIELD(locus_diagram_stats, relaxations, 24);
    FIELD(locus_diagram_stats, iterations, 32);
    FIELD(locus_diagram_stats, max_exact, 40);
    FIELD(locus_diagram_stats, max_distance, 48);
    FIELD(locus_diagram_stats, seconds_import, 56);
    FIELD(locus_diagram_stats, seconds_solve, 64);
    FIELD(locus_diagram_stats, seconds_export, 72);
    FIELD(locus_diagram_stats, bytes, 80);
    FIELD(locus_diagram_stats, engine, 88);
    FIELD(locus_diagram_stats, threads, 92);
    FIELD(locus_diagram_stats, backend, 96);
    FIELD(locus_diagram_stats, reserved0, 100);

    SIZE(locus_cell_pair, 16);
    FIELD(locus_cell_pair, a, 0);
    FIELD(locus_cell_pair, b, 4);
    FIELD(locus_cell_pair, edges, 8);

    SIZE(locus_weights_options, 40);
    FIELD(locus_weights_options, struct_size, 0);
    FIELD(locus_weights_options, method, 8);
    FIELD(locus_weights_options, max_per_row, 12);
    FIELD(locus_weights_options, batch_bytes, 16);
    FIELD(locus_weights_options, progress, 24);
    FIELD(locus_weights_options, progress_user, 32);

    SIZE(locus_place_options, 48);
    FIELD(locus_place_options, struct_size, 0);
    FIELD(locus_place_options, count, 8);
    FIELD(locus_place_options, first_id, 16);
    FIELD(locus_place_options, lloyd_iterations, 20);
    FIELD(locus_place_options, metric, 24);
    FIELD(locus_place_options, reserved0, 28);
    FIELD(locus_place_options, progress, 32);
    FIELD(locus_place_options, progress_user, 40);

    SIZE(locus_graph_options, 168);
    FIELD(locus_graph_options, struct_size, 0);
    FIELD(locus_graph_options, dims, 8);
    FIELD(locus_graph_options, spacing, 32);
    FIELD(locus_graph_options, connectivity, 56);
    FIELD(locus_graph_options, weight_rule, 60);
    FIELD(locus_graph_options, material, 64);
    FIELD(locus_graph_options, word_bits, 68);
    FIELD(locus_graph_options, stiffness_exponent, 72);
    FIELD(locus_graph_options, weight, 80);
    FIELD(locus_graph_options, weight_user, 88);
    FIELD(locus_graph_options, max_seeds, 96);
    FIELD(locus_graph_options, scale, 104);
    FIELD(locus_graph_options, precision, 112);
    FIELD(locus_graph_options, material_min, 120);
    FIELD(locus_graph_options, material_max, 128);
    FIELD(locus_graph_options, threads, 136);
    FIELD(locus_graph_options, backend, 140);
    FIELD(locus_graph_options, simd, 144);
    FIELD(locus_graph_options, reserved0, 148);
    FIELD(locus_graph_options, log, 152);
    FIELD(locus_graph_options, log_user, 160);

    SIZE(locus_graph_info, 144);
    FIELD(locus_graph_info, struct_size, 0);
    FIELD(locus_graph_info, dims, 8);
    FIELD(locus_graph_info, spacing, 32);
    FIELD(locus_graph_info, passable, 56);
    FIELD(locus_graph_info, bytes, 64);
    FIELD(locus_graph_info, connectivity, 72);
    FIELD(locus_graph_info, weight_rule, 76);
    FIELD(locus_graph_info, word_bits, 80);
    FIELD(locus_graph_info, label_bits, 84);
    FIELD(locus_graph_info, scale, 88);
    FIELD(locus_graph_info, max_exact, 96);
    FIELD(locus_graph_info, max_distance, 104);
    FIELD(locus_graph_info, weight_error, 112);
    FIELD(locus_graph_info, smallest_step, 120);
    FIELD(locus_graph_info, overflow_free, 128);
    FIELD(locus_graph_info, threads, 132);
    FIELD(locus_graph_info, backend, 136);
    FIELD(locus_graph_info, simd, 140);

    SIZE(locus_voxel_box, 48);
    FIELD(locus_voxel_box, origin, 0);
    FIELD(locus_voxel_box, extent, 24);

    SIZE(locus_point32, 32);
    FIELD(locus_point32, latitude, 0);
    FIELD(locus_point32, longitude, 8);
    FIELD(locus_point32, time, 16);
    FIELD(locus_point32, device, 24);
    FIELD(locus_point32, application, 26);
    FIELD(locus_point32, language, 28);
    FIELD(locus_point32, spare, 30);

    SIZE(locus_text156, 156);
    FIELD(locus_text156, latitude, 0);
    FIELD(locus_text156, longitude, 4);
    FIELD(locus_text156, time, 8);
    FIELD(locus_text156, text, 16);

    SIZE(locus_pmq_options, 144);
    FIELD(locus_pmq_options, struct_size, 0);
    FIELD(locus_pmq_options, record, 8);
    FIELD(locus_pmq_options, layout, 12);
    FIELD(locus_pmq_options, index, 16);
    FIELD(locus_pmq_options, future, 20);
    FIELD(locus_pmq_options, horizon, 24);
    FIELD(locus_pmq_options, max_records, 32);
    FIELD(locus_pmq_options, max_bytes, 40);
    FIELD(locus_pmq_options, remove, 48);
    FIELD(locus_pmq_options, remove_user, 56);
    FIELD(locus_pmq_options, sink, 64);
    FIELD(locus_pmq_options, sink_user, 72);
    FIELD(locus_pmq_options, log, 80);
    FIELD(locus_pmq_options, log_user, 88);
    FIELD(locus_pmq_options, segment_slots, 96);
    FIELD(locus_pmq_options, reserved0, 100);
    FIELD(locus_pmq_options, rho_leaf, 104);
    FIELD(locus_pmq_options, tau_leaf, 112);
    FIELD(locus_pmq_options, rho_root, 120);
    FIELD(locus_pmq_options, tau_root, 128);
    FIELD(locus_pmq_options, snapshot_bytes, 136);

    SIZE(locus_box, 32);
    FIELD(locus_box, south, 0);
    FIELD(locus_box, west, 8);
    FIELD(locus_box, north, 16);
    FIELD(locus_box, east, 24);

    SIZE(locus_circle, 24);
    FIELD(locus_circle, latitude, 0);
    FIELD(locus_circle, longitude, 8);
    FIELD(locus_circle, radius, 16);

    SIZE(locus_position, 16);
    FIELD(locus_position, latitude, 0);
    FIELD(locus_position, longitude, 8);

    SIZE(locus_polygon, 24);
    FIELD(locus_polygon, vertices, 0);
    FIELD(locus_polygon, ring_sizes, 8);
    FIELD(locus_polygon, rings, 16);

    SIZE(locus_pmq_query, 152);
    FIELD(locus_pmq_query, struct_size, 0);
    FIELD(locus_pmq_query, region, 8);
    FIELD(locus_pmq_query, expired, 12);
    FIELD(locus_pmq_query, box, 16);
    FIELD(locus_pmq_query, time_from, 48);
    FIELD(locus_pmq_query, time_to, 56);
    FIELD(locus_pmq_query, filter, 64);
    FIELD(locus_pmq_query, filter_user, 72);
    FIELD(locus_pmq_query, snapshot, 80);
    FIELD(locus_pmq_query, circle, 88);
    FIELD(locus_pmq_query, polygon, 112);
    FIELD(locus_pmq_query, left, 136);
    FIELD(locus_pmq_query, order, 144);
    FIELD(locus_pmq_query, reserved0, 148);

    SIZE(locus_key_range, 24);
    FIELD(locus_key_range, first, 0);
    FIELD(locus_key_range, last, 8);
    FIELD(locus_key_range, inside, 16);
    FIELD(locus_key_range, reserved0, 20);

    SIZE(locus_pmq_score, 48);
    FIELD(locus_pmq_score, struct_size, 0);
    FIELD(locus_pmq_score, latitude, 8);
    FIELD(locus_pmq_score, longitude, 16);
    FIELD(locus_pmq_score, radius, 24);
    FIELD(locus_pmq_score, alpha, 32);
    FIELD(locus_pmq_score, period, 40);

    SIZE(locus_pmq_cursor, 16);
    FIELD(locus_pmq_cursor, key, 0);
    FIELD(locus_pmq_cursor, passed, 8);

    SIZE(locus_pmq_group, 24);
    FIELD(locus_pmq_group, value, 0);
    FIELD(locus_pmq_group, count, 8);
    FIELD(locus_pmq_group, newest, 16);

    SIZE(locus_alert, 96);
    FIELD(locus_alert, number, 0);
    FIELD(locus_alert, kind, 8);
    FIELD(locus_alert, zoom, 12);
    FIELD(locus_alert, x, 16);
    FIELD(locus_alert, y, 20);
    FIELD(locus_alert, box, 24);
    FIELD(locus_alert, time, 56);
    FIELD(locus_alert, records, 64);
    FIELD(locus_alert, rate, 72);
    FIELD(locus_alert, expected, 80);
    FIELD(locus_alert, share, 88);

    SIZE(locus_alerts_options, 112);
    FIELD(locus_alerts_options, struct_size, 0);
    FIELD(locus_alerts_options, zoom_from, 8);
    FIELD(locus_alerts_options, zoom_to, 12);
    FIELD(locus_alerts_options, half_life, 16);
    FIELD(locus_alerts_options, history, 24);
    FIELD(locus_alerts_options, cool_down, 32);
    FIELD(locus_alerts_options, minimum, 40);
    FIELD(locus_alerts_options, factor, 48);
    FIELD(locus_alerts_options, rate, 56);
    FIELD(locus_alerts_options, share, 64);
    FIELD(locus_alerts_options, max_bytes, 72);
    FIELD(locus_alerts_options, alert, 80);
    FIELD(locus_alerts_options, alert_user, 88);
    FIELD(locus_alerts_options, fence, 96);
    FIELD(locus_alerts_options, fence_user, 104);

    SIZE(locus_alerts_stats, 48);
    FIELD(locus_alerts_stats, struct_size, 0);
    FIELD(locus_alerts_stats, regions, 8);
    FIELD(locus_alerts_stats, fences, 16);
    FIELD(locus_alerts_stats, raised, 24);
    FIELD(locus_alerts_stats, shown, 32);
    FIELD(locus_alerts_stats, bytes, 40);

    SIZE(locus_pmq_file_info, 40);
    FIELD(locus_pmq_file_info, struct_size, 0);
    FIELD(locus_pmq_file_info, version, 8);
    FIELD(locus_pmq_file_info, record, 12);
    FIELD(locus_pmq_file_info, records, 16);
    FIELD(locus_pmq_file_info, bytes, 24);
    FIELD(locus_pmq_file_info, now, 32);

    SIZE(locus_pmq_log_options, 40);
    FIELD(locus_pmq_log_options, struct_size, 0);
    FIELD(locus_pmq_log_options, sync, 8);
    FIELD(locus_pmq_log_options, redeliver, 12);
    FIELD(locus_pmq_log_options, sync_interval, 16);
    FIELD(locus_pmq_log_options, sync_bytes, 24);
    FIELD(locus_pmq_log_options, keep, 32);
    FIELD(locus_pmq_log_options, repair, 36);

    SIZE(locus_pmq_recovery, 80);
    FIELD(locus_pmq_recovery, struct_size, 0);
    FIELD(locus_pmq_recovery, created, 8);
    FIELD(locus_pmq_recovery, skipped, 12);
    FIELD(locus_pmq_recovery, number, 16);
    FIELD(locus_pmq_recovery, saved, 24);
    FIELD(locus_pmq_recovery, changes, 32);
    FIELD(locus_pmq_recovery, inserted, 40);
    FIELD(locus_pmq_recovery, departed, 48);
    FIELD(locus_pmq_recovery, records, 56);
    FIELD(locus_pmq_recovery, cut, 64);
    FIELD(locus_pmq_recovery, now, 72);

    SIZE(locus_pmq_log_stats, 56);
    FIELD(locus_pmq_log_stats, struct_size, 0);
    FIELD(locus_pmq_log_stats, number, 8);
    FIELD(locus_pmq_log_stats, bytes, 16);
    FIELD(locus_pmq_log_stats, unsynced, 24);
    FIELD(locus_pmq_log_stats, changes, 32);
    FIELD(locus_pmq_log_stats, syncs, 40);
    FIELD(locus_pmq_log_stats, attached, 48);
    FIELD(locus_pmq_log_stats, stopped, 52);

    SIZE(locus_pmq_stats, 136);
    FIELD(locus_pmq_stats, struct_size, 0);
    FIELD(locus_pmq_stats, records, 8);
    FIELD(locus_pmq_stats, stored, 16);
    FIELD(locus_pmq_stats, pending, 24);
    FIELD(locus_pmq_stats, slots, 32);
    FIELD(locus_pmq_stats, bytes, 40);
    FIELD(locus_pmq_stats, inserted, 48);
    FIELD(locus_pmq_stats, evicted, 56);
    FIELD(locus_pmq_stats, erased, 64);
    FIELD(locus_pmq_stats, batches, 72);
    FIELD(locus_pmq_stats, moved, 80);
    FIELD(locus_pmq_stats, rebalances, 88);
    FIELD(locus_pmq_stats, grows, 96);
    FIELD(locus_pmq_stats, shrinks, 104);
    FIELD(locus_pmq_stats, longest_pause_ns, 112);
    FIELD(locus_pmq_stats, density, 120);
    FIELD(locus_pmq_stats, now, 128);

    SIZE(locus_cold_options, 80);
    FIELD(locus_cold_options, struct_size, 0);
    FIELD(locus_cold_options, record, 8);
    FIELD(locus_cold_options, sync, 12);
    FIELD(locus_cold_options, when_full, 16);
    FIELD(locus_cold_options, reserved0, 20);
    FIELD(locus_cold_options, queue_bytes, 24);
    FIELD(locus_cold_options, batch_records, 32);
    FIELD(locus_cold_options, delay, 40);
    FIELD(locus_cold_options, run_records, 48);
    FIELD(locus_cold_options, cache_bytes, 56);
    FIELD(locus_cold_options, max_age, 64);
    FIELD(locus_cold_options, max_bytes, 72);

    SIZE(locus_cold_stats, 104);
    FIELD(locus_cold_stats, struct_size, 0);
    FIELD(locus_cold_stats, received, 8);
    FIELD(locus_cold_stats, written, 16);
    FIELD(locus_cold_stats, removed, 24);
    FIELD(locus_cold_stats, stored, 32);
    FIELD(locus_cold_stats, runs, 40);
    FIELD(locus_cold_stats, queue_bytes, 48);
    FIELD(locus_cold_stats, file_bytes, 56);
    FIELD(locus_cold_stats, free_bytes, 64);
    FIELD(locus_cold_stats, transactions, 72);
    FIELD(locus_cold_stats, waits, 80);
    FIELD(locus_cold_stats, now, 88);
    FIELD(locus_cold_stats, failure, 96);
    FIELD(locus_cold_stats, reserved0, 100);

    SIZE(locus_records_options, 80);
    FIELD(locus_records_options, struct_size, 0);
    FIELD(locus_records_options, record, 8);
    FIELD(locus_records_options, format, 12);
    FIELD(locus_records_options, time_unit, 16);
    FIELD(locus_records_options, bad_lines, 20);
    FIELD(locus_records_options, separator, 24);
    FIELD(locus_records_options, max_line, 28);
    FIELD(locus_records_options, time_column, 32);
    FIELD(locus_records_options, latitude_column, 40);
    FIELD(locus_records_options, longitude_column, 48);
    FIELD(locus_records_options, text_column, 56);
    FIELD(locus_records_options, bad_line, 64);
    FIELD(locus_records_options, bad_line_user, 72);

    SIZE(locus_records_stats, 64);
    FIELD(locus_records_stats, struct_size, 0);
    FIELD(locus_records_stats, records, 8);
    FIELD(locus_records_stats, bad, 16);
    FIELD(locus_records_stats, cut, 24);
    FIELD(locus_records_stats, repaired, 32);
    FIELD(locus_records_stats, line, 40);
    FIELD(locus_records_stats, bytes_read, 48);
    FIELD(locus_records_stats, bytes, 56);

    SIZE(locus_volume_info, 192);
    FIELD(locus_volume_info, struct_size, 0);
    FIELD(locus_volume_info, dims, 8);
    FIELD(locus_volume_info, components, 32);
    FIELD(locus_volume_info, spacing, 40);
    FIELD(locus_volume_info, origin, 64);
    FIELD(locus_volume_info, direction, 88);
    FIELD(locus_volume_info, slope, 160);
    FIELD(locus_volume_info, intercept, 168);
    FIELD(locus_volume_info, type, 176);
    FIELD(locus_volume_info, file_type, 180);
    FIELD(locus_volume_info, format, 184);
    FIELD(locus_volume_info, big_endian, 188);

    SIZE(locus_volume_read_options, 128);
    FIELD(locus_volume_read_options, struct_size, 0);
    FIELD(locus_volume_read_options, memory_limit, 8);
    FIELD(locus_volume_read_options, numbers, 16);
    FIELD(locus_volume_read_options, format, 20);
    FIELD(locus_volume_read_options, allow_trailing, 24);
    FIELD(locus_volume_read_options, raw_big_endian, 28);
    FIELD(locus_volume_read_options, raw_type, 32);
    FIELD(locus_volume_read_options, raw_interleaved, 36);
    FIELD(locus_volume_read_options, raw_dims, 40);
    FIELD(locus_volume_read_options, raw_components, 64);
    FIELD(locus_volume_read_options, raw_offset, 72);
    FIELD(locus_volume_read_options, raw_spacing, 80);
    FIELD(locus_volume_read_options, raw_origin, 104);

    SIZE(locus_volume_write_options, 16);
    FIELD(locus_volume_write_options, struct_size, 0);
    FIELD(locus_volume_write_options, format, 8);
    FIELD(locus_volume_write_options, compression, 12);
    return check_result();
}
