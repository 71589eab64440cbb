//! Graphs, diagrams and weights against brute force on small grids.
use locus::*;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, AtomicI64, Ordering};
use std::sync::Arc;

const DIMS: [u64; 3] = [7, 6, 5];
const VOXELS: usize = 7 * 6 * 5;

struct Random(u64);
impl Random {
    fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) % end
    }
}

fn material(random: &mut Random) -> Vec<f32> {
    (0..VOXELS).map(|_| if random.below(5) == 0 { f32::NAN } else { 1.0 + random.below(8) as f32 }).collect()
}

fn seeds(random: &mut Random, material: &[f32], count: u32) -> Vec<Seed> {
    let mut found = Vec::new();
    while (found.len() as u32) < count {
        let at = random.below(VOXELS as u64);
        if !material[at as usize].is_nan() {
            let id = 100 + found.len() as u32;
            found.push(Seed { x: at % 7, y: at / 7 % 6, z: at / 42, id, ..Seed::default() });
        }
    }
    found
}

fn index(x: u64, y: u64, z: u64) -> u64 {
    x + 7 * (y + 6 * z)
}

/// Bellman and Ford over the graph's own integer weights: exact distances, and labels with the earlier seed on ties.
fn oracle(graph: &Graph, seeds: &[Seed]) -> (Vec<u64>, Vec<u32>) {
    let mut best = vec![(u64::MAX, usize::MAX); VOXELS];
    for (order, seed) in seeds.iter().enumerate() {
        let at = &mut best[index(seed.x, seed.y, seed.z) as usize];
        *at = (*at).min((0, order));
    }
    let mut edges = Vec::new();
    for u in 0..VOXELS as u64 {
        for v in 0..VOXELS as u64 {
            let steps = graph.edge_weight(u, v).unwrap();
            if steps > 0 {
                edges.push((u as usize, v as usize, steps));
            }
        }
    }
    loop {
        let mut changed = false;
        for &(u, v, steps) in &edges {
            if best[u].0 != u64::MAX && (best[u].0 + steps, best[u].1) < best[v] {
                best[v] = (best[u].0 + steps, best[u].1);
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
    let labels = best.iter().map(|found| seeds.get(found.1).map_or(NO_SEED, |seed| seed.id)).collect();
    (best.iter().map(|found| found.0).collect(), labels)
}

#[test]
fn solves_and_updates_as_brute_force_does() {
    let mut random = Random(1);
    for engine in [Engine::Heap, Engine::Bucket, Engine::Relax, Engine::Bricks] {
        let values = material(&mut random);
        let mut graph = Graph::new(GraphOptions::new(DIMS).threads(1), Some(&values)).unwrap();
        let read = graph.materials(None).unwrap();
        assert!(read.iter().zip(&values).all(|(a, b)| a == b || a.is_nan() && b.is_nan()));
        let mut diagram = Diagram::with(&graph, &DiagramOptions::default().engine(engine)).unwrap();
        let seeds = seeds(&mut random, &values, 5);
        diagram.add_seeds(&seeds).unwrap();
        diagram.solve().unwrap();
        let same = |graph: &Graph, diagram: &Diagram| {
            let (exact, labels) = oracle(graph, &seeds);
            assert_eq!(diagram.distances_exact(None).unwrap(), exact);
            assert_eq!(diagram.labels(None).unwrap(), labels);
            let sizes: Vec<u64> = seeds.iter().map(|seed| labels.iter().filter(|&&id| id == seed.id).count() as u64).collect();
            assert_eq!(diagram.cell_sizes().unwrap(), sizes);
        };
        same(&graph, &diagram);
        let cut = graph.cut_plane([3.5, 0.0, 0.0], [1.0, 0.0, 0.0], None).unwrap();
        assert!(cut > 0 && diagram.update().unwrap().voxels > 0);
        same(&graph, &diagram);
        assert_eq!(graph.mend_box(None).unwrap(), cut);
        diagram.update().unwrap();
        same(&graph, &diagram);
    }
}

#[test]
fn paths_add_up_and_seeds_are_kept() {
    let mut random = Random(2);
    let values = material(&mut random);
    let graph = Graph::new(GraphOptions::new(DIMS).threads(1), Some(&values)).unwrap();
    let mut diagram = Diagram::new(&graph).unwrap();
    let given = seeds(&mut random, &values, 3);
    diagram.add_seeds(&given).unwrap();
    assert_eq!(diagram.seeds().unwrap(), given);
    diagram.solve().unwrap();
    let exact = diagram.distances_exact(None).unwrap();
    for at in 0..VOXELS as u64 {
        let path = diagram.path([at % 7, at / 7 % 6, at / 42]).unwrap();
        let length: u64 = path.windows(2).map(|pair| graph.edge_weight(pair[0], pair[1]).unwrap()).sum();
        assert_eq!(if path.is_empty() { u64::MAX } else { length }, exact[at as usize]);
    }
    diagram.place_seeds(&PlaceOptions::new(2).first_id(7), |_| true).unwrap();
    assert_eq!(diagram.seeds().unwrap().len(), 5);
    diagram.remove_seeds(&[7]).unwrap();
    assert!(matches!(diagram.remove_seeds(&[7]), Err(Error::Argument(text)) if text.contains('7')));
}

#[test]
fn weights_outlive_their_diagram_and_interpolate() {
    let graph = Graph::new(GraphOptions::new(DIMS).threads(1), Some(&[1.0; VOXELS])).unwrap();
    let mut diagram = Diagram::new(&graph).unwrap();
    diagram.add_seeds(&seeds(&mut Random(3), &[1.0; VOXELS], 4)).unwrap();
    diagram.solve().unwrap();
    let mut weights = Weights::new(&mut diagram, WeightsOptions::default(), None).unwrap();
    let some = Weights::of(&mut diagram, WeightsOptions::default().method(Method::Laplace), &[3, 5]).unwrap();
    assert_eq!(some.size().unwrap().0, 2);
    drop(diagram);
    drop(graph);
    let rows = weights.rows(0..VOXELS as u64).unwrap();
    let values = [1.0, 2.0, 4.0, 8.0];
    let dense = weights.dense(0..VOXELS as u64, &[100, 101, 102, 103]).unwrap();
    let out = weights.interpolate(0..VOXELS as u64, &values, 1).unwrap();
    for row in 0..VOXELS {
        let by_hand: f32 = rows.row(row).map(|(id, weight)| weight * values[id as usize - 100]).sum();
        assert!((by_hand - out[row]).abs() < 1e-4);
        for (id, weight) in rows.row(row) {
            assert_eq!(dense[row * 4 + id as usize - 100], weight);
        }
    }
    assert_eq!(weights.gradients(0..2, 100).unwrap().len(), 2);
    assert_eq!(weights.update().unwrap(), []);
    for bad in [0..VOXELS as u64 + 1, u64::MAX - 1..u64::MAX] {
        assert!(matches!(weights.rows(bad.clone()), Err(Error::Argument(_))));
        assert!(matches!(weights.gradients(bad.clone(), 100), Err(Error::Argument(_))));
        assert!(matches!(weights.dense(bad.clone(), &[100]), Err(Error::Argument(_))));
        assert!(matches!(weights.interpolate(bad, &values, 1), Err(Error::Argument(_))));
    }
    assert!(matches!(weights.interpolate(0..1, &values[..3], 1), Err(Error::Argument(_))));
}

#[test]
fn refuses_what_does_not_fit() {
    assert!(
        matches!(Graph::new(GraphOptions::new(DIMS), Some(&[1.0; 3])), Err(Error::Argument(text)) if text.contains("3 values"))
    );
    let mut graph = Graph::new(GraphOptions::new(DIMS), Some(&[1.0; VOXELS])).unwrap();
    let outside = VoxelBox { origin: [u64::MAX, 0, 0], extent: [2, 1, 1] };
    assert!(matches!(graph.materials(outside), Err(Error::Argument(_))));
    assert!(matches!(graph.fill_box(outside, 1.0), Err(Error::Argument(_))));
    assert!(matches!(graph.set_box(VoxelBox { origin: [0; 3], extent: [2; 3] }, &[1.0]), Err(Error::Argument(_))));
    assert!(matches!(graph.set_voxels(&[1], &[]), Err(Error::Argument(_))));
    let mut diagram = Diagram::new(&graph).unwrap();
    let error = diagram.solve().unwrap_err();
    assert_eq!((error.name(), error.status()), ("LOCUS_E_STATE", sys::LOCUS_E_STATE));
    assert!(matches!(diagram.labels(outside), Err(Error::State(_) | Error::Argument(_))));
}

#[test]
fn a_panicking_weight_function_leaves_no_result() {
    const PLENTY: i64 = 1_000_000;
    for engine in [Engine::Heap, Engine::Bucket, Engine::Relax, Engine::Bricks] {
        let left = Arc::new(AtomicI64::new(PLENTY));
        let seen = left.clone();
        let weight = move |_: u64, _: u64, length: f64| {
            assert!(seen.fetch_sub(1, Ordering::Relaxed) > 0, "no further");
            2.0 * length
        };
        let options = GraphOptions::new(DIMS).threads(1).material_min(2.0).material_max(2.0).weight(weight);
        let graph = Graph::new(options, Some(&[1.0; VOXELS])).unwrap();
        let mut diagram = Diagram::with(&graph, &DiagramOptions::default().engine(engine)).unwrap();
        diagram.add_seeds(&[Seed::default()]).unwrap();
        left.store(PLENTY, Ordering::Relaxed);
        diagram.solve().unwrap();
        let calls = PLENTY - left.load(Ordering::Relaxed);
        // At the first call, amid them, and at the last one, behind every report of progress.
        for good in [0, calls / 2, calls - 1] {
            left.store(good, Ordering::Relaxed);
            let mut fresh = Diagram::with(&graph, &DiagramOptions::default().engine(engine)).unwrap();
            fresh.add_seeds(&[Seed::default()]).unwrap();
            assert!(catch_unwind(AssertUnwindSafe(|| fresh.solve())).is_err());
            assert!(matches!(fresh.labels(None), Err(Error::State(_))), "{:?} after {} of {}", engine, good, calls);
            left.store(PLENTY, Ordering::Relaxed);
            fresh.solve().unwrap();
            assert_eq!(fresh.distances(None).unwrap(), diagram.distances(None).unwrap());
        }
    }
}

#[test]
fn callbacks_stop_and_panics_come_out() {
    let graph = Graph::new(GraphOptions::new(DIMS).threads(1), Some(&[1.0; VOXELS])).unwrap();
    let mut diagram = Diagram::new(&graph).unwrap();
    diagram.add_seeds(&[Seed::default()]).unwrap();
    assert!(matches!(diagram.solve_with(|_| false), Err(Error::Stopped(_))));
    let panic = catch_unwind(AssertUnwindSafe(|| diagram.solve_with(|_| panic!("no further")))).unwrap_err();
    assert_eq!(panic.downcast_ref::<&str>(), Some(&"no further"));
    diagram.solve().unwrap();
    // A caller's weights, on several threads.
    let armed = Arc::new(AtomicBool::new(false));
    let seen = armed.clone();
    let weight = move |_: u64, _: u64, length: f64| {
        assert!(!seen.load(Ordering::Relaxed), "armed");
        2.0 * length
    };
    let options = GraphOptions::new(DIMS).threads(2).material_min(2.0).material_max(2.0).weight(weight);
    let graph = Graph::new(options, Some(&[1.0; VOXELS])).unwrap();
    let mut doubled = Diagram::new(&graph).unwrap();
    doubled.add_seeds(&[Seed::default()]).unwrap();
    doubled.solve().unwrap();
    let (once, twice) = (diagram.distances(None).unwrap(), doubled.distances(None).unwrap());
    assert!(once.iter().zip(&twice).all(|(a, b)| (2.0 * a - b).abs() < 0.1));
    armed.store(true, Ordering::Relaxed);
    let mut fresh = Diagram::new(&graph).unwrap();
    fresh.add_seeds(&[Seed::default()]).unwrap();
    assert!(catch_unwind(AssertUnwindSafe(|| fresh.solve())).is_err());
    armed.store(false, Ordering::Relaxed);
    fresh.solve().unwrap();
    assert_eq!(fresh.distances(None).unwrap(), twice);
}

#[test]
fn a_change_of_the_graph_beside_a_solve_is_busy() {
    let mut graph = Graph::new(GraphOptions::new(DIMS).threads(1), Some(&[1.0; VOXELS])).unwrap();
    let mut diagram = Diagram::new(&graph).unwrap();
    diagram.add_seeds(&[Seed::default()]).unwrap();
    let mut result = None;
    diagram
        .solve_with(|_| {
            let all = VoxelBox { origin: [0; 3], extent: DIMS };
            result.get_or_insert(graph.fill_box(all, 2.0));
            true
        })
        .unwrap();
    assert!(matches!(result, Some(Err(Error::Busy(_)))));
}
