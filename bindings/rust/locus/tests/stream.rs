//! Stores, snapshots, alerts and storage against a plain model.
use locus::*;
use std::collections::HashMap;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::{Arc, Mutex};

struct Random(u64);
impl Random {
    fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) % end
    }
}

fn batch(random: &mut Random, count: usize, now: i64) -> Vec<Point32> {
    (0..count)
        .map(|_| Point32 {
            latitude: 40.0 + random.below(1000) as f64 / 100.0,
            longitude: random.below(1000) as f64 / 100.0,
            time: now - random.below(10) as i64,
            device: random.below(5) as u16,
            ..Point32::default()
        })
        .collect()
}

fn sorted(mut records: Vec<Point32>) -> Vec<Point32> {
    records.sort_by_key(|record| key(record.latitude, record.longitude).unwrap());
    records
}

const BOX: GeoBox = GeoBox { south: 42.0, west: 3.0, north: 47.0, east: 8.0 };

fn in_box(record: &Point32) -> bool {
    (42.0..=47.0).contains(&record.latitude) && (3.0..=8.0).contains(&record.longitude)
}

#[test]
fn answers_as_a_plain_list_does() {
    for layout in [Layout::RingLeaves, Layout::PackedArray] {
        let mut random = Random(1);
        let left = Arc::new(Mutex::new(Vec::new()));
        let sink = left.clone();
        let options = StoreOptions::default().layout(layout).horizon(50).sink(move |record: &Point32| {
            sink.lock().unwrap().push(*record);
            true
        });
        let store = Store::new(options).unwrap();
        let (mut model, mut given) = (Vec::new(), 0);
        for now in (0..200).step_by(10) {
            let records = batch(&mut random, 60, now);
            store.insert(&records, now).unwrap();
            given += records.len();
            model.extend(records);
            model.retain(|record| record.time >= now - 50);
            let all = sorted(model.clone());
            assert_eq!(store.read(&Query::new()).unwrap(), all);
            let within: Vec<_> = all.iter().copied().filter(in_box).collect();
            assert_eq!(store.read(&Query::new().within(BOX)).unwrap(), within);
            let corner = |latitude, longitude| Position { latitude, longitude };
            let ring = [corner(42.0, 3.0), corner(42.0, 8.0), corner(47.0, 8.0), corner(47.0, 3.0)];
            assert_eq!(store.read(&Query::new().polygon([&ring[..]])).unwrap(), within);
            let odd = Query::new().filter(|record: &Point32| record.device % 2 == 1).between(now - 30, now - 1);
            let wanted = all.iter().filter(|r| r.device % 2 == 1 && r.time >= now - 30 && r.time < now).count();
            assert_eq!(store.count(&odd).unwrap(), wanted as u64);
            store.check().unwrap();
        }
        store.sweep(199).unwrap();
        assert_eq!(left.lock().unwrap().len() as u64 + store.stats().unwrap().records, given as u64);
        let mut counts = HashMap::new();
        for record in store.read(&Query::new()).unwrap() {
            *counts.entry(u64::from(record.device)).or_insert(0) += 1;
        }
        for groups in [store.groups(&Query::new(), Field::Device), store.groups_by(&Query::new(), |r| r.device.into())] {
            let found: HashMap<u64, u64> = groups.unwrap().iter().map(|group| (group.value, group.count)).collect();
            assert_eq!(found, counts);
        }
        let total: u32 = store.tile([0, 0, 0], 4, &Query::new()).unwrap().iter().sum();
        let sum: f64 = store.weighted_tile([0, 0, 0], 4, &Query::new(), |_| 0.5).unwrap().iter().sum();
        assert_eq!((u64::from(total), sum * 2.0), (counts.values().sum(), f64::from(total)));
        let devices = |query: Query| {
            let mut found: Vec<u16> = store.read(&query).unwrap().iter().map(|record| record.device).collect();
            found.sort_unstable();
            found
        };
        assert_eq!(devices(Query::new().in_any_order()), devices(Query::new()));
        assert!(store.count(&Query::new().expired()).unwrap() >= store.stats().unwrap().records);
        assert!(matches!(store.erase(&Query::new().expired()), Err(Error::Argument(text)) if text.contains("expired")));
        let erased = store.erase(&Query::new().within(BOX)).unwrap();
        assert!(erased > 0 && store.count(&Query::new().within(BOX)).unwrap() == 0);
    }
}

#[test]
fn pages_snapshots_and_ranks() {
    let store = Store::new(StoreOptions::default()).unwrap();
    let records = batch(&mut Random(2), 300, 10);
    store.insert(&records, 10).unwrap();
    let snapshot = store.snapshot().unwrap();
    store.erase(&Query::new()).unwrap();
    let then = Query::new().at(&snapshot);
    let (mut cursor, mut paged) = (Cursor::default(), Vec::new());
    loop {
        let page = store.read_page(&then, &mut cursor, 7).unwrap();
        if page.is_empty() {
            break;
        }
        paged.extend(page);
    }
    assert_eq!(paged, sorted(records.clone()));
    assert_eq!((store.count(&then).unwrap(), store.count(&Query::new()).unwrap()), (300, 0));
    let nearest = store.nearest(45.0, 5.0, 20, &then).unwrap();
    assert!(nearest.len() == 20 && nearest.windows(2).all(|pair| pair[0].1 <= pair[1].1));
    let haversine = |record: &Point32| {
        let (a, b) = (record.latitude.to_radians(), 45.0_f64.to_radians());
        let (dy, dx) = (((a - b) / 2.0).sin(), ((record.longitude - 5.0).to_radians() / 2.0).sin());
        2.0 * sys::LOCUS_EARTH_RADIUS * (dy * dy + a.cos() * b.cos() * dx * dx).sqrt().asin()
    };
    let mut distances: Vec<f64> = records.iter().map(haversine).collect();
    distances.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert!(nearest.iter().zip(&distances).all(|(found, wanted)| (found.1 - wanted).abs() < 1e-3));
    let top = store.topk(&Score::new(45.0, 5.0).radius(1e6).alpha(1.0), 5, &then).unwrap();
    assert!(top.iter().zip(&distances).all(|(found, wanted)| (found.1 * 1e6 - wanted).abs() < 1e-3));
    drop((then, store));
    drop(snapshot);
}

#[test]
fn callbacks_stop_panic_and_may_not_come_back() {
    let store = Arc::new(Store::new(StoreOptions::default()).unwrap());
    store.insert(&batch(&mut Random(3), 50, 10), 10).unwrap();
    let mut seen = 0;
    let stopped = store.visit(&Query::new(), |_| {
        seen += 1;
        seen < 3
    });
    assert!(matches!(stopped, Err(Error::Stopped(_))) && seen == 3);
    assert!(catch_unwind(AssertUnwindSafe(|| store.visit(&Query::new(), |_| panic!("visitor")))).is_err());
    let angry = Query::new().filter(|_: &Point32| panic!("filter"));
    assert!(catch_unwind(AssertUnwindSafe(|| store.count(&angry))).is_err());
    assert_eq!(store.count(&Query::new()).unwrap(), 50);
    let back = store.clone();
    let nosy = Query::new().filter(move |_: &Point32| matches!(back.count(&Query::new()), Err(Error::Busy(_))));
    assert_eq!(store.count(&nosy).unwrap(), 50);
    let options = StoreOptions::default().horizon(1).sink(|_: &Point32| panic!("sink"));
    let store = Store::new(options).unwrap();
    store.insert(&[Point32::default()], 0).unwrap();
    let panic = catch_unwind(AssertUnwindSafe(|| store.sweep(10))).unwrap_err();
    assert_eq!(panic.downcast_ref::<&str>(), Some(&"sink"));
    assert_eq!(store.sweep(10).unwrap(), 0);
}

#[test]
fn alerts_tell_and_end_within_their_callback() {
    let store = Arc::new(Store::new(StoreOptions::default()).unwrap());
    let holder: Arc<Mutex<Option<Alerts>>> = Arc::default();
    let (inside, asked, told) = (holder.clone(), store.clone(), Arc::new(Mutex::new(Vec::new())));
    let shown = told.clone();
    let options = AlertsOptions::default().fence(move |fence, record: &Point32| {
        assert!(matches!(asked.insert(&[], 100), Err(Error::Busy(_))));
        shown.lock().unwrap().push((fence, record.device, asked.count(&Query::new()).unwrap()));
        drop(inside.lock().unwrap().take());
        true
    });
    let alerts = Alerts::new(&store, options).unwrap();
    alerts.add_fence_where(9, &Query::new().within(BOX), |record| record.device == 3).unwrap();
    assert!(matches!(alerts.add_fence(9, &Query::new()), Err(Error::Argument(_))));
    alerts.add_fence_where(8, &Query::new(), |_| true).unwrap();
    alerts.remove_fence(8).unwrap();
    assert_eq!((alerts.stats().unwrap().fences, alerts.active().unwrap().len()), (1, 0));
    *holder.lock().unwrap() = Some(alerts);
    let at = |device| Point32 { latitude: 45.0, longitude: 5.0, device, ..Point32::default() };
    store.insert(&[at(1), at(3), at(3)], 0).unwrap();
    store.insert(&[at(3)], 1).unwrap();
    assert_eq!(*told.lock().unwrap(), [(9, 3, 3)]);
    // A region that stands out; a panic of the callback comes out of the insert, which is done.
    let options = AlertsOptions::default().rate(1e-9).minimum(5.0).alert(|alert| panic!("{}", alert.kind));
    let loud = Alerts::<Point32>::new(&store, options).unwrap();
    let records = vec![Point32 { time: 5, ..at(0) }; 100];
    assert!(catch_unwind(AssertUnwindSafe(|| store.insert(&records, 5))).is_err());
    assert!(store.count(&Query::new()).unwrap() == 104 && !loud.active().unwrap().is_empty());
    drop(store);
    drop(loud);
}

#[test]
fn threads_insert_ask_and_end_alerts_beside_each_other() {
    let store = Store::new(StoreOptions::default().max_records(500)).unwrap();
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let mut random = Random(4);
            for now in 0..100 {
                store.insert(&batch(&mut random, 20, now), now).unwrap();
            }
        });
        for _ in 0..20 {
            if let Ok(alerts) = Alerts::new(&store, AlertsOptions::default().fence(|_, _| true)) {
                alerts.add_fence_where(1, &Query::new(), |record: &Point32| record.device == 1).unwrap();
                alerts.remove_fence(1).unwrap();
            }
            assert!(store.read(&Query::new().within(BOX)).unwrap().iter().all(in_box));
        }
    });
    store.check().unwrap();
}

#[test]
fn files_and_folders_bring_the_store_back() {
    let folder = std::env::temp_dir().join(format!("locus-rust-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("saved");
    let store = Store::new(StoreOptions::default()).unwrap();
    store.insert(&batch(&mut Random(5), 200, 10), 10).unwrap();
    let all = store.read(&Query::new()).unwrap();
    assert!(matches!(store.save(&file, None, |_| false), Err(Error::Stopped(_))));
    store.save(&file, None, |_| true).unwrap();
    assert_eq!(file_info(&file).unwrap().records, 200);
    let options = || StoreOptions::default().layout(Layout::PackedArray);
    assert_eq!(Store::load(&file, options(), |_| true).unwrap().read(&Query::new()).unwrap(), all);
    let wrong = Store::<Text156>::load(&file, StoreOptions::default(), |_| true);
    assert!(matches!(wrong, Err(Error::Argument(_) | Error::Format(_))));
    assert!(matches!(Store::<Point32>::load(folder.join("none"), options(), |_| true), Err(Error::Io(_))));
    assert!(matches!(store.checkpoint(|_| true), Err(Error::State(_))));
    let log = LogOptions::default().sync(Sync::None);
    store.attach(folder.join("log"), &log, |_| true).unwrap();
    store.insert(&batch(&mut Random(6), 100, 20), 20).unwrap();
    store.sync().unwrap();
    store.checkpoint(|_| true).unwrap();
    store.insert(&batch(&mut Random(7), 10, 30), 30).unwrap();
    assert_eq!((store.log_stats().unwrap().attached, store.log_stats().unwrap().changes), (1, 2));
    let busy = Store::<Point32>::open(folder.join("log"), options(), &log, |_| true);
    assert!(matches!(busy, Err(Error::Busy(_))));
    let all = store.read(&Query::new()).unwrap();
    drop(store);
    let (store, found) = Store::open(folder.join("log"), options(), &log, |_| true).unwrap();
    assert_eq!((store.read(&Query::new()).unwrap(), found.saved, found.inserted), (all, 300, 10));
    drop(store);
    std::fs::remove_dir_all(&folder).unwrap();
}
