//! Both engines in one walk: a soft bar that is cut, and a stream with a window, a fence and a folder.
use locus::*;
use std::sync::{Arc, Mutex};

fn voxels() -> Result<()> {
    // A bar of 5 voxels whose middle is ten times softer, and a seed at either end.
    let mut graph = Graph::new(GraphOptions::new([5, 1, 1]), Some(&[1.0, 1.0, 10.0, 1.0, 1.0]))?;
    let mut diagram = Diagram::new(&graph)?;
    diagram.add_seeds(&[Seed { id: 7, ..Seed::default() }, Seed { x: 4, id: 8, ..Seed::default() }])?;
    diagram.solve()?;
    println!("distances {:?}, labels {:?}", diagram.distances(None)?, diagram.labels(None)?);
    let weights = Weights::new(&mut diagram, WeightsOptions::default(), None)?;
    println!("in the middle weigh {:?}", weights.rows(2..3)?.row(0).collect::<Vec<_>>());
    // A cut, and only what changes is computed anew.
    graph.fill_box(VoxelBox { origin: [1, 0, 0], extent: [1, 1, 1] }, f32::NAN)?;
    println!("{} voxels changed: {:?}", diagram.update()?.voxels, diagram.labels(None)?);
    Ok(())
}

fn stream() -> Result<()> {
    // The last hour of a stream; what leaves it goes to an archive.
    let hour = 3_600_000_000;
    let archive = Arc::new(Mutex::new(Vec::new()));
    let sink = archive.clone();
    let store = Store::new(StoreOptions::default().horizon(hour).sink(move |record: &Point32| {
        sink.lock().unwrap().push(record.device);
        true
    }))?;
    let options = AlertsOptions::default().fence(|fence, record: &Point32| {
        println!("device {} came into fence {fence}", record.device);
        true
    });
    let alerts = Alerts::new(&store, options)?;
    alerts.add_fence(1, &Query::new().circle(Circle { latitude: 48.86, longitude: 2.35, radius: 5_000.0 }))?;
    let paris = Point32 { latitude: 48.8566, longitude: 2.3522, time: 0, device: 1, ..Point32::default() };
    let tokyo = Point32 { latitude: 35.6762, longitude: 139.6503, time: hour, device: 2, ..Point32::default() };
    store.insert(&[paris], 0)?;
    let before = store.snapshot()?;
    store.insert(&[tokyo], hour)?;
    store.sweep(hour + 1)?;
    println!("{} record now, archived {:?}", store.count(&Query::new())?, archive.lock().unwrap());
    println!("then: device {}", store.read(&Query::new().at(&before))?[0].device);
    Ok(())
}

fn main() -> Result<()> {
    voxels()?;
    stream()
}
