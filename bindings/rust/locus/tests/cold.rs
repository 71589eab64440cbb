//! The cold tier, against a store that keeps everything.
#![cfg(feature = "cold")]
use locus::*;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

const MINUTE: i64 = 60_000_000;

/// A folder that goes with the test.
struct Folder(PathBuf);
impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("locus-cold-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }
    fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}
impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Records a second apart, some of them at one place.
fn posts(count: i64) -> Vec<Point32> {
    let mut state = 7_u64;
    let mut below = |end: u64| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) % end
    };
    (0..count)
        .map(|number| Point32 {
            latitude: if number % 7 == 0 { 48.5 } else { below(16_000) as f64 / 100.0 - 80.0 },
            longitude: if number % 7 == 0 { 2.5 } else { below(36_000) as f64 / 100.0 - 180.0 },
            time: number * 1_000_000,
            device: below(5) as u16,
            spare: number as u16,
            ..Point32::default()
        })
        .collect()
}

/// A window of three minutes with its tier, and a store that keeps everything.
fn both(path: &Path, records: &[Point32], options: &ColdOptions, layout: Layout) -> (Cold, Store, Store) {
    let cold = Cold::open(path, options).unwrap();
    let store = Store::new(StoreOptions::default().layout(layout).horizon(3 * MINUTE).cold(&cold)).unwrap();
    let everything = Store::new(StoreOptions::default()).unwrap();
    for batch in records.chunks(50) {
        for one in [&store, &everything] {
            one.insert(batch, batch[batch.len() - 1].time).unwrap();
        }
    }
    (cold, store, everything)
}

#[test]
fn store_and_tier_answer_together() {
    let folder = Folder::new("together");
    let records = posts(2000);
    for layout in [Layout::RingLeaves, Layout::PackedArray] {
        let path = folder.file(&format!("{layout:?}.db"));
        let (cold, store, everything) = both(&path, &records, &ColdOptions::default(), layout);
        let ring = [(-41.0, -100.0), (-59.0, 90.0), (50.0, 100.0)];
        let ring = ring.map(|(latitude, longitude)| Position { latitude, longitude });
        let late = 31 * MINUTE;
        let queries = [
            Query::new(),
            Query::new().within(GeoBox { south: -30.0, west: -20.0, north: 55.0, east: 60.0 }),
            Query::new().circle(Circle { latitude: 48.5, longitude: 2.5, radius: 2e6 }).between(5 * MINUTE, late),
            Query::new().polygon([ring]),
            Query::new().filter(|record: &Point32| record.device == 3),
        ];
        for _when in ["at once", "in the file"] {
            assert!(store.count(&Query::new()).unwrap() < 250);
            for query in &queries {
                let wanted = everything.read(query).unwrap();
                assert_eq!(cold.read(Some(&store), query).unwrap(), wanted);
                assert_eq!(cold.count(Some(&store), query).unwrap(), wanted.len() as u64);
                let mut seen = Vec::new();
                cold.visit(Some(&store), query, |record| {
                    seen.push(*record);
                    true
                })
                .unwrap();
                assert_eq!(seen, wanted);
            }
            store.sweep(records[1999].time).unwrap();
            cold.flush().unwrap();
        }
        cold.check().unwrap();
        let alone = cold.count(None, &Query::new()).unwrap();
        assert_eq!(alone + store.count(&Query::new()).unwrap(), 2000);
        let stats = cold.stats().unwrap();
        assert_eq!((stats.received, stats.written, stats.failure), (alone, alone, 0));
    }
}

#[test]
fn the_moment_of_a_snapshot() {
    let folder = Folder::new("snapshot");
    let records = posts(1000);
    let (cold, store, everything) = both(&folder.file("tier.db"), &records, &ColdOptions::default(), Layout::RingLeaves);
    let moment = store.snapshot().unwrap();
    store.erase(&Query::new()).unwrap();
    let then = Query::new().at(&moment);
    assert_eq!(cold.read(Some(&store), &then).unwrap(), everything.read(&Query::new()).unwrap());
    assert_eq!(cold.count(None, &Query::new()).unwrap(), 1000);
    assert!(matches!(cold.count(None, &then), Err(Error::Argument(_))));
}

#[test]
fn closures_stop_panic_and_must_not_call_back() {
    let folder = Folder::new("closures");
    let records = posts(300);
    let (cold, store, _) = both(&folder.file("tier.db"), &records, &ColdOptions::default(), Layout::RingLeaves);
    let mut seen = 0;
    let stopped = cold.visit(Some(&store), &Query::new(), |_| {
        seen += 1;
        seen < 4
    });
    assert!(matches!(stopped, Err(Error::Stopped(_))) && seen == 4);
    let visited = || cold.visit(Some(&store), &Query::new(), |_| panic!("mine"));
    assert_eq!(*catch_unwind(AssertUnwindSafe(visited)).unwrap_err().downcast::<&str>().unwrap(), "mine");
    let bad = Query::new().filter(|_: &Point32| panic!("mine too"));
    let counted = || cold.count(Some(&store), &bad);
    assert_eq!(*catch_unwind(AssertUnwindSafe(counted)).unwrap_err().downcast::<&str>().unwrap(), "mine too");
    let all = Query::new();
    let busy = |result: Result<()>| assert!(matches!(result, Err(Error::Busy(_))), "{result:?}");
    let stopped = cold.visit(Some(&store), &all, |_| {
        busy(cold.count(None, &all).map(drop));
        busy(cold.flush());
        busy(cold.sweep(0));
        busy(cold.rewind(0));
        busy(cold.check());
        busy(cold.stats().map(drop));
        busy(store.insert(&[], 300_000_000));
        busy(store.sweep(300_000_000).map(drop));
        busy(store.erase(&all).map(drop));
        busy(store.count(&all).map(drop));
        busy(Store::new(StoreOptions::default().cold(&cold)).map(drop));
        false
    });
    assert!(matches!(stopped, Err(Error::Stopped(_))));
    store
        .visit(&all, |_| {
            busy(cold.count(Some(&store), &all).map(drop));
            true
        })
        .unwrap();
    assert_eq!(cold.count(Some(&store), &all).unwrap(), 300);
}

#[test]
fn age_restart_and_rewind() {
    let folder = Folder::new("restart");
    let path = folder.file("tier.db");
    let records = posts(600);
    let options = ColdOptions::default().max_age(5 * MINUTE).sync(ColdSync::Full).delay(1000);
    let (cold, store, _) = both(&path, &records, &options, Layout::RingLeaves);
    let (all, end) = (Query::new(), records[599].time);
    store.sweep(end).unwrap();
    cold.sweep(end).unwrap();
    cold.flush().unwrap();
    let young = records.iter().filter(|record| record.time >= end - 5 * MINUTE).count() as u64;
    assert_eq!(cold.count(Some(&store), &all).unwrap(), young);
    assert_eq!(cold.stats().unwrap().removed, 600 - young);
    assert!(matches!(cold.sweep(0), Err(Error::Argument(text)) if text.contains("now is 0")));
    assert!(matches!(cold.rewind(0), Err(Error::State(_))));
    assert!(matches!(Cold::<Point32>::open(&path, &ColdOptions::default()), Err(Error::Busy(_))));
    let (kept, received) = (cold.count(None, &all).unwrap(), cold.stats().unwrap().received);
    drop(cold); // the store keeps it
    assert!(matches!(Cold::<Point32>::open(&path, &ColdOptions::default()), Err(Error::Busy(_))));
    drop(store);
    let other = Cold::<Text156>::open(&path, &ColdOptions::default()).map(drop);
    assert!(matches!(other, Err(Error::Argument(text)) if text.contains("holds records of 32 bytes")));
    let cold = Cold::open(&path, &ColdOptions::default()).unwrap();
    assert_eq!(cold.count(None, &all).unwrap(), kept);
    cold.rewind(received - 10).unwrap();
    assert_eq!(cold.count(None, &all).unwrap(), kept - 10);
}

#[test]
fn one_store_at_a_time() {
    let folder = Folder::new("one");
    let (all, records) = (Query::new(), posts(10));
    let cold = Cold::open(folder.file("tier.db"), &ColdOptions::default()).unwrap();
    let store = Store::new(StoreOptions::default().cold(&cold)).unwrap();
    assert!(matches!(Store::new(StoreOptions::default().cold(&cold)), Err(Error::State(_))));
    let stranger = Store::new(StoreOptions::default()).unwrap();
    assert!(matches!(cold.count(Some(&stranger), &all), Err(Error::Argument(_))));
    store.insert(&records, 10_000_000).unwrap();
    store.erase(&all).unwrap();
    store.save(folder.file("store"), None, |_| true).unwrap();
    drop(store);
    let two = Store::new(StoreOptions::default().cold(&cold).sink(|_| true)).map(drop);
    assert!(matches!(two, Err(Error::Argument(text)) if text.contains("sink is set")));
    assert!(Store::load(folder.file("none"), StoreOptions::default().cold(&cold), |_| true).is_err());
    let again = Store::load(folder.file("store"), StoreOptions::default().cold(&cold), |_| true).unwrap();
    again.insert(&records[..5], 10_000_000).unwrap();
    assert_eq!(cold.count(Some(&again), &all).unwrap(), 15);
}

#[test]
fn questions_beside_the_writer() {
    let folder = Folder::new("beside");
    let records = posts(20_000);
    let cold = Cold::open(folder.file("tier.db"), &ColdOptions::default().queue_bytes(1 << 20)).unwrap();
    let store = Store::new(StoreOptions::default().horizon(3 * MINUTE).cold(&cold)).unwrap();
    let done = AtomicBool::new(false);
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while !done.load(Ordering::Relaxed) {
                    assert_eq!(cold.count(Some(&store), &Query::new()).unwrap() % 100, 0);
                    assert_eq!(cold.read(Some(&store), &Query::new()).unwrap().len() % 100, 0);
                }
            });
        }
        for batch in records.chunks(100) {
            store.insert(batch, batch[99].time).unwrap();
        }
        done.store(true, Ordering::Relaxed);
    });
    assert_eq!(cold.count(Some(&store), &Query::new()).unwrap(), 20_000);
}

#[test]
fn texts_and_errors() {
    let folder = Folder::new("errors");
    let cold = Cold::open(folder.file("tier.db"), &ColdOptions::default()).unwrap();
    let store = Store::<Text156>::new(StoreOptions::default().cold(&cold)).unwrap();
    let mut post = Text156::default();
    post.text[..7].copy_from_slice(b"Bonjour");
    store.insert(&[post], 0).unwrap();
    store.erase(&Query::new()).unwrap();
    assert_eq!(&cold.read(Some(&store), &Query::new()).unwrap()[0].text[..8], b"Bonjour\0");
    let open = |name: &str, options: ColdOptions| Cold::open(folder.file(name), &options).map(drop);
    assert!(matches!(open("none/tier.db", ColdOptions::default()), Err(Error::Io(text)) if text.contains("none/tier.db")));
    std::fs::write(folder.file("text"), "this is no database").unwrap();
    assert!(matches!(open("text", ColdOptions::default()), Err(Error::Format(_))));
    let small = ColdOptions::default().queue_bytes(1).when_full(ColdFull::Refuse);
    assert!(matches!(open("new.db", small), Err(Error::Argument(text)) if text.contains("queue_bytes is 1")));
}
