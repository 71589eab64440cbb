use crate::callback::{guard, log_at, Gate, HasGate, Log, Logger};
use crate::error::{check, listed};
use crate::{sys, Cursor, Error, Field, Group, Point32, Query, Result, Score, Text156};
use std::any::Any;
use std::os::raw::c_void;
use std::ptr::{null_mut, NonNull};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, Weak};
use std::thread::{current, ThreadId};

/// The statistics of a store.
pub use sys::locus_pmq_stats as StoreStats;

constants! {
    /// How records lie in memory; both give the same answers.
    Layout {
        /// leaves along the Z-curve, each a ring
        RingLeaves = LOCUS_LAYOUT_RING_LEAVES,
        /// the packed-memory array
        PackedArray = LOCUS_LAYOUT_PACKED_ARRAY,
    }
    /// How the packed array finds the records of a quadrant.
    Index {
        /// binary search
        Implicit = LOCUS_INDEX_IMPLICIT,
        /// a pointer quadtree
        Explicit = LOCUS_INDEX_EXPLICIT,
        /// keys apart from the records, and a tree of samples over the segments' first keys
        Heads = LOCUS_INDEX_HEADS,
    }
    /// What to do with a time after `now`.
    Future {
        /// refuse the batch
        Refuse = LOCUS_FUTURE_REFUSE,
        /// store it as `now`
        Clamp = LOCUS_FUTURE_CLAMP,
    }
}

/// A record layout of the library.
///
/// # Safety
/// The type lies in memory as the library's layout `KIND` does.
pub unsafe trait Record: Copy + Default + Send + Sync + 'static {
    /// `LOCUS_RECORD_`
    const KIND: u32;
}
// SAFETY: the structs of the C headers.
unsafe impl Record for Point32 {
    const KIND: u32 = sys::LOCUS_RECORD_POINT32;
}
unsafe impl Record for Text156 {
    const KIND: u32 = sys::LOCUS_RECORD_TEXT156;
}

type Decide<R> = Box<dyn FnMut(&R) -> bool + Send>;

/// How to make a store: `locus_pmq_options` in `locus/pmq.h`.
pub struct StoreOptions<R: Record = Point32> {
    plain: sys::locus_pmq_options,
    remove: Option<Decide<R>>,
    sink: Option<Decide<R>>,
    log: Option<Log>,
    pub(crate) tier: Option<Arc<dyn Tier>>,
}

impl<R: Record> Default for StoreOptions<R> {
    fn default() -> Self {
        let mut plain = defaults!(locus_pmq_options, locus_pmq_options_init);
        plain.record = R::KIND;
        Self { plain, remove: None, sink: None, log: None, tier: None }
    }
}

impl<R: Record> StoreOptions<R> {
    setters! {
        /// Default [`Layout::RingLeaves`].
        layout: Layout => u32::from;
        /// Of the packed array; default [`Index::Implicit`].
        index: Index => u32::from;
        /// Default [`Future::Refuse`].
        future: Future => u32::from;
        /// Microseconds a record lives; default: no horizon.
        horizon: i64;
        /// Most live records; default: no limit.
        max_records: u64;
        /// Most memory of slots and index, bytes; default: no limit.
        max_bytes: u64;
        /// Slots per segment of the packed array, a power of two; default 8.
        segment_slots: u32;
        /// Lowest density of a segment; default 0.08.
        rho_leaf: f64;
        /// Highest density of a segment; default 0.92.
        tau_leaf: f64;
        /// Lowest density of the array; default 0.30.
        rho_root: f64;
        /// Highest density of the array; default 0.70.
        tau_root: f64;
        /// Most memory kept only for snapshots, bytes.
        snapshot_bytes: u64;
    }

    /// True: the record may go. It must not call into the store.
    #[must_use]
    pub fn remove(mut self, remove: impl FnMut(&R) -> bool + Send + 'static) -> Self {
        self.remove = Some(Box::new(remove));
        self
    }

    /// Takes over a record that has left; false stops, and what is behind waits for the next change. It must not call
    /// into the store.
    #[must_use]
    pub fn sink(mut self, sink: impl FnMut(&R) -> bool + Send + 'static) -> Self {
        self.sink = Some(Box::new(sink));
        self
    }

    /// Be told lines of text.
    #[must_use]
    pub fn log(mut self, log: impl Fn(i32, &str) + Send + Sync + 'static) -> Self {
        self.log = Some(Box::new(log));
        self
    }
}

/// What takes over, instead of a sink, the records that left: the cold tier.
pub(crate) trait Tier: Send + Sync {
    /// Be the sink of the options, of one store at a time.
    fn attach(&self, options: &mut sys::locus_pmq_options) -> Result<()>;
    /// The store has ended.
    fn detach(&self);
    /// Refuse what must not be called from within a callback of the tier.
    fn outside(&self) -> Result<()>;
}

/// A tier that a store is attached to: it ends behind the store.
pub(crate) struct Attached(Arc<dyn Tier>);

impl Attached {
    fn new(tier: Arc<dyn Tier>, options: &mut sys::locus_pmq_options) -> Result<Self> {
        tier.attach(options)?;
        Ok(Self(tier))
    }
}

impl Drop for Attached {
    fn drop(&mut self) {
        self.0.detach();
    }
}

/// What a store shares with its alerts, which may outlive it.
pub(crate) struct Shared<R> {
    pub(crate) gate: Gate,
    remove: Option<Mutex<Decide<R>>>,
    sink: Option<Mutex<Decide<R>>>,
    logger: Option<Logger>,
    tier: Option<Weak<dyn Tier>>,
    writer: Mutex<Writer>,
    left: Condvar,
}

/// Who inserts into the store or changes the list of its alerts, and what goes when it is done.
#[derive(Default)]
struct Writer {
    inside: Option<(ThreadId, bool)>, // true: it adds or ends alerts, which is soon over
    ended: Vec<Box<dyn Any + Send>>,
}

impl<R: Record> HasGate for Shared<R> {
    fn gate(&self) -> &Gate {
        &self.gate
    }
}

pub(crate) struct Writing<'s, R: Record>(&'s Shared<R>);

impl<R: Record> Shared<R> {
    fn writer(&self) -> MutexGuard<'_, Writer> {
        self.writer.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Insert, or add alerts, which is `brief`: where nobody inserts.
    pub(crate) fn write(&self, brief: bool) -> Result<Writing<'_, R>> {
        let mut writer = self.writer();
        while let Some((thread, soon_over)) = writer.inside {
            if thread == current().id() || !soon_over {
                return Err(Error::Busy("another thread changes the store, or this is its callback".into()));
            }
            writer = self.left.wait(writer).unwrap_or_else(PoisonError::into_inner);
        }
        writer.inside = Some((current().id(), brief));
        Ok(Writing(self))
    }

    /// End something that an insert uses: after it. This thread's own insert does it when it is done.
    pub(crate) fn end(&self, what: Box<dyn Any + Send>) {
        let mut writer = self.writer();
        while let Some((thread, _)) = writer.inside {
            if thread == current().id() {
                writer.ended.push(what);
                return;
            }
            writer = self.left.wait(writer).unwrap_or_else(PoisonError::into_inner);
        }
        writer.inside = Some((current().id(), true));
        writer.ended.push(what);
        drop(writer);
        drop(Writing(self));
    }

    /// Refuse what only the callbacks of alerts may call.
    fn gate(&self) -> Result<&Gate> {
        if let Some(tier) = self.tier.as_ref().and_then(Weak::upgrade) {
            tier.outside()?;
        }
        self.gate.outside("store")?;
        Ok(&self.gate)
    }

    /// Refuse what must not be called from within a callback.
    fn outside(&self) -> Result<()> {
        self.gate()?;
        if matches!(self.writer().inside, Some((thread, _)) if thread == current().id()) {
            return Err(Error::Busy("the store is at work, and this is its callback".into()));
        }
        Ok(())
    }
}

impl<R: Record> Drop for Writing<'_, R> {
    fn drop(&mut self) {
        loop {
            let mut writer = self.0.writer();
            let ended = std::mem::take(&mut writer.ended);
            if ended.is_empty() {
                writer.inside = None;
                self.0.left.notify_all();
                return;
            }
            drop(writer);
            drop(ended);
        }
    }
}

unsafe extern "C" fn remove_at<R: Record>(record: *const c_void, user: *mut c_void) -> i32 {
    let shared = &*(user as *const Shared<R>);
    decide(shared, &shared.remove, record, -1, i32::from)
}

unsafe extern "C" fn sink_at<R: Record>(record: *const c_void, user: *mut c_void) -> i32 {
    let shared = &*(user as *const Shared<R>);
    decide(shared, &shared.sink, record, 1, |go_on| i32::from(!go_on))
}

unsafe fn decide<R: Record>(
    shared: &Shared<R>,
    closure: &Option<Mutex<Decide<R>>>,
    record: *const c_void,
    stop: i32,
    answer: impl FnOnce(bool) -> i32,
) -> i32 {
    match closure {
        Some(closure) => {
            guard(&shared.gate, stop, || answer(closure.lock().unwrap_or_else(PoisonError::into_inner)(&*(record as *const R))))
        }
        None => stop,
    }
}

/// One moment of a store, for several queries; it may outlive the store.
pub struct Snapshot {
    handle: NonNull<sys::locus_pmq_snapshot>,
}

// SAFETY: queries only read it, and it ends when no query borrows it.
unsafe impl Send for Snapshot {}
unsafe impl Sync for Snapshot {}

impl Snapshot {
    pub(crate) fn raw(&self) -> *const sys::locus_pmq_snapshot {
        self.handle.as_ptr()
    }
}

impl Drop for Snapshot {
    fn drop(&mut self) {
        // SAFETY: the handle is this object's alone.
        unsafe { sys::locus_pmq_snapshot_destroy(self.handle.as_ptr()) }
    }
}

/// The live window of a stream of geo-located records. One thread at a time changes it, and any number may ask.
///
/// ```
/// use locus::{GeoBox, Point32, Query, Store, StoreOptions};
/// # fn main() -> locus::Result<()> {
/// let hour = 3_600_000_000;
/// let store = Store::new(StoreOptions::default().horizon(hour))?;
/// let paris = Point32 { latitude: 48.8566, longitude: 2.3522, time: 1_000, ..Point32::default() };
/// let tokyo = Point32 { latitude: 35.6762, longitude: 139.6503, time: 2_000, ..Point32::default() };
/// store.insert(&[paris, tokyo], 2_000)?;
/// let near = GeoBox { south: 48.0, west: 2.0, north: 49.0, east: 3.0 };
/// assert_eq!(store.count(&Query::new().within(near))?, 1);
/// assert_eq!(store.sweep(hour + 1_500)?, 1);
/// assert_eq!(store.read(&Query::new())?, [tokyo]);
/// # Ok(()) }
/// ```
///
/// A snapshot lives as long as the queries that ask it:
///
/// ```compile_fail
/// # use locus::{Query, Store, StoreOptions, Point32};
/// let store = Store::<Point32>::new(StoreOptions::default()).unwrap();
/// let query = Query::new().at(&store.snapshot().unwrap());
/// store.count(&query);
/// ```
pub struct Store<R: Record = Point32> {
    handle: NonNull<sys::locus_pmq>,
    shared: Arc<Shared<R>>,
    attached: Option<Attached>,
}

// SAFETY: the library lets one thread in that changes the store beside any number that ask; closures are Send, and
// called by the one that changes it.
unsafe impl<R: Record> Send for Store<R> {}
unsafe impl<R: Record> Sync for Store<R> {}

impl<R: Record> Store<R> {
    /// An empty store.
    pub fn new(options: StoreOptions<R>) -> Result<Self> {
        // SAFETY: the options outlive the call.
        Self::make(options, |_, plain, made| unsafe { sys::locus_pmq_create(plain, made) })
    }

    pub(crate) fn make(
        options: StoreOptions<R>,
        create: impl FnOnce(&Gate, *const sys::locus_pmq_options, *mut *mut sys::locus_pmq) -> i32,
    ) -> Result<Self> {
        let StoreOptions { mut plain, remove, sink, log, tier } = options;
        let shared = Arc::new_cyclic(|owner: &Weak<Shared<R>>| Shared {
            gate: Gate::default(),
            remove: remove.map(Mutex::new),
            sink: sink.map(Mutex::new),
            logger: log.map(|log| Logger { log, owner: owner.clone() }),
            tier: tier.as_ref().map(Arc::downgrade),
            writer: Mutex::default(),
            left: Condvar::new(),
        });
        let user = Arc::as_ptr(&shared) as *mut c_void;
        if shared.remove.is_some() {
            plain.remove = Some(remove_at::<R>);
            plain.remove_user = user;
        }
        if shared.sink.is_some() {
            plain.sink = Some(sink_at::<R>);
            plain.sink_user = user;
        }
        if let Some(logger) = &shared.logger {
            plain.log = Some(log_at);
            plain.log_user = logger as *const Logger as *mut c_void;
        }
        let attached = tier.map(|tier| Attached::new(tier, &mut plain)).transpose()?;
        let mut made = null_mut();
        let status = create(&shared.gate, &plain, &mut made);
        let store = NonNull::new(made).map(|handle| Self { handle, shared: shared.clone(), attached });
        check(status)?;
        store.ok_or_else(|| Error::Internal("the store was not made".into()))
    }

    pub(crate) fn raw(&self) -> *mut sys::locus_pmq {
        self.handle.as_ptr()
    }

    pub(crate) fn shared(&self) -> &Arc<Shared<R>> {
        &self.shared
    }

    /// A call that may not come from a callback of the store.
    pub(crate) fn outside(&self) -> Result<&Gate> {
        self.shared.outside()?;
        Ok(&self.shared.gate)
    }

    /// A call that asks, which callbacks of alerts may do.
    fn gate(&self) -> Result<&Gate> {
        self.shared.gate()
    }

    /// Is it this tier that takes over what leaves the store?
    #[cfg(feature = "cold")]
    pub(crate) fn attached_to(&self, tier: *const ()) -> bool {
        matches!(&self.attached, Some(Attached(own)) if Arc::as_ptr(own) as *const () == tier)
    }

    fn ask(
        &self,
        query: &Query<'_, R>,
        call: impl FnOnce(*const sys::locus_pmq, *const sys::locus_pmq_query) -> i32,
    ) -> Result<()> {
        query.ask(self.gate()?, |plain| call(self.raw(), plain))
    }

    /// Insert a batch in its order of arrival, set the clock to `now`, and evict what has to go.
    pub fn insert(&self, records: &[R], now: i64) -> Result<()> {
        self.gate()?;
        let _writing = self.shared.write(false)?;
        // SAFETY: as many records as said, of the store's layout.
        check(unsafe { sys::locus_pmq_insert(self.raw(), records.as_ptr() as *const c_void, records.len(), now) })
    }

    /// Set the clock and evict everything that may go: how many left.
    pub fn sweep(&self, now: i64) -> Result<u64> {
        self.gate()?;
        let mut evicted = 0;
        // SAFETY: the handle is alive.
        check(unsafe { sys::locus_pmq_sweep(self.raw(), now, &mut evicted) })?;
        Ok(evicted)
    }

    /// Remove what a query selects: how many.
    pub fn erase(&self, query: &Query<'_, R>) -> Result<u64> {
        let mut erased = 0;
        // SAFETY: the handle is alive; the library lets one thread change the store.
        self.ask(query, |_, plain| unsafe { sys::locus_pmq_erase(self.raw(), plain, &mut erased) })?;
        Ok(erased)
    }

    /// How many records a query selects.
    pub fn count(&self, query: &Query<'_, R>) -> Result<u64> {
        let mut count = 0;
        // SAFETY: the handle is alive.
        self.ask(query, |this, plain| unsafe { sys::locus_pmq_count(this, plain, &mut count) })?;
        Ok(count)
    }

    /// The records that a query selects, in the order (key, arrival).
    pub fn read(&self, query: &Query<'_, R>) -> Result<Vec<R>> {
        let gate = self.gate()?;
        // SAFETY: there is room for as many records as said.
        listed(|into, capacity, count| {
            query.status(gate, |plain| unsafe { sys::locus_pmq_read(self.raw(), plain, into as *mut c_void, capacity, count) })
        })
    }

    /// Show the records to a closure; false stops, which is [`Error::Stopped`].
    pub fn visit(&self, query: &Query<'_, R>, mut visitor: impl FnMut(&R) -> bool) -> Result<()> {
        let mut call = Call { gate: self.gate()?, closure: &mut |record: &R| i32::from(!visitor(record)), otherwise: 1 };
        // SAFETY: the closure outlives the call.
        self.ask(query, |this, plain| unsafe { sys::locus_pmq_visit(this, plain, Some(call_at::<R, i32>), call.user()) })
    }

    /// Go on in the store's order behind the cursor, up to `capacity` records; none: the end.
    pub fn read_page(&self, query: &Query<'_, R>, cursor: &mut Cursor, capacity: usize) -> Result<Vec<R>> {
        let mut page = room::<R>(capacity)?;
        let mut count = 0;
        // SAFETY: there is room for as many records as said.
        self.ask(query, |this, plain| unsafe {
            sys::locus_pmq_read_page(this, plain, cursor, page.as_mut_ptr() as *mut c_void, capacity, &mut count)
        })?;
        page.truncate(count);
        Ok(page)
    }

    /// Count records by an id field, the largest group first.
    pub fn groups(&self, query: &Query<'_, R>, field: Field) -> Result<Vec<Group>> {
        let gate = self.gate()?;
        // SAFETY: there is room for as many groups as said.
        listed(|into, capacity, count| {
            query.status(gate, |plain| unsafe {
                sys::locus_pmq_groups(self.raw(), plain, field.into(), None, null_mut(), into, capacity, count)
            })
        })
    }

    /// Count records by what a closure says of them; it may be asked more than once.
    pub fn groups_by(&self, query: &Query<'_, R>, mut group: impl FnMut(&R) -> u64) -> Result<Vec<Group>> {
        let gate = self.gate()?;
        let mut call = Call { gate, closure: &mut group, otherwise: 0 };
        let user = call.user();
        // SAFETY: the closure outlives the calls; there is room for as many groups as said.
        listed(|into, capacity, count| {
            query.status(gate, |plain| unsafe {
                let (field, at) = (sys::LOCUS_FIELD_CALLER, Some(call_at::<R, u64> as unsafe extern "C" fn(_, _) -> _));
                sys::locus_pmq_groups(self.raw(), plain, field, at, user, into, capacity, count)
            })
        })
    }

    /// Count records per bin of the Web-Mercator tile \[zoom, x, y\], 2^log2_bins a side, from the north-west.
    pub fn tile(&self, [zoom, x, y]: [u32; 3], log2_bins: u32, query: &Query<'_, R>) -> Result<Vec<u32>> {
        let mut bins = vec![0; bins(log2_bins)];
        // SAFETY: there is room for as many bins as said.
        self.ask(query, |this, plain| unsafe {
            sys::locus_pmq_tile(this, zoom, x, y, log2_bins, plain, bins.as_mut_ptr(), bins.len(), null_mut())
        })?;
        Ok(bins)
    }

    /// The same with each record counted as its weight.
    pub fn weighted_tile(
        &self,
        [zoom, x, y]: [u32; 3],
        log2_bins: u32,
        query: &Query<'_, R>,
        mut weight: impl FnMut(&R) -> f64,
    ) -> Result<Vec<f64>> {
        let mut bins = vec![0.0; bins(log2_bins)];
        let mut call = Call { gate: self.gate()?, closure: &mut weight, otherwise: 0.0 };
        let (user, at) = (call.user(), Some(call_at::<R, f64> as unsafe extern "C" fn(_, _) -> _));
        // SAFETY: the closure outlives the call; there is room for as many bins as said.
        self.ask(query, |this, plain| unsafe {
            let (into, room) = (bins.as_mut_ptr(), bins.len());
            sys::locus_pmq_weighted_tile(this, zoom, x, y, log2_bins, plain, at, user, into, room, null_mut())
        })?;
        Ok(bins)
    }

    /// The k records with the lowest scores, with those.
    pub fn topk(&self, score: &Score, k: usize, query: &Query<'_, R>) -> Result<Vec<(R, f64)>> {
        // SAFETY: there is room for k of both.
        self.ranked(k, query, |plain, records, scores, count| unsafe {
            sys::locus_pmq_topk(self.raw(), &score.plain, plain, k, records, scores, count)
        })
    }

    /// The k records nearest to a place, with their distances in metres.
    pub fn nearest(&self, latitude: f64, longitude: f64, k: usize, query: &Query<'_, R>) -> Result<Vec<(R, f64)>> {
        // SAFETY: there is room for k of both.
        self.ranked(k, query, |plain, records, distances, count| unsafe {
            sys::locus_pmq_nearest(self.raw(), latitude, longitude, plain, k, records, distances, count)
        })
    }

    fn ranked(
        &self,
        k: usize,
        query: &Query<'_, R>,
        call: impl FnOnce(*const sys::locus_pmq_query, *mut c_void, *mut f64, *mut usize) -> i32,
    ) -> Result<Vec<(R, f64)>> {
        let (mut records, mut values, mut count) = (room::<R>(k)?, room::<f64>(k)?, 0);
        let into = records.as_mut_ptr() as *mut c_void;
        self.ask(query, |_, plain| call(plain, into, values.as_mut_ptr(), &mut count))?;
        Ok(records.into_iter().zip(values).take(count).collect())
    }

    /// Keep the present moment for several queries; with ring leaves.
    pub fn snapshot(&self) -> Result<Snapshot> {
        self.gate()?;
        let mut made = null_mut();
        // SAFETY: the handle is alive.
        check(unsafe { sys::locus_pmq_snapshot_create(self.raw(), &mut made) })?;
        let handle = NonNull::new(made).ok_or_else(|| Error::Internal("the snapshot was not made".into()))?;
        Ok(Snapshot { handle })
    }

    /// The statistics.
    pub fn stats(&self) -> Result<StoreStats> {
        self.gate()?;
        let mut stats = sized!(locus_pmq_stats);
        // SAFETY: the handle is alive.
        check(unsafe { sys::locus_pmq_get_stats(self.raw(), &mut stats) })?;
        Ok(stats)
    }

    /// Verify every invariant of the store.
    pub fn check(&self) -> Result<()> {
        self.gate()?;
        // SAFETY: the handle is alive.
        check(unsafe { sys::locus_pmq_check(self.raw()) })
    }
}

impl<R: Record> Drop for Store<R> {
    fn drop(&mut self) {
        // Alerts may end on another thread meanwhile.
        self.shared.end(Box::new(Ended { handle: self.handle, _attached: self.attached.take() }));
    }
}

struct Ended {
    handle: NonNull<sys::locus_pmq>,
    _attached: Option<Attached>, // goes behind the store
}
// SAFETY: any thread may end a store.
unsafe impl Send for Ended {}
impl Drop for Ended {
    fn drop(&mut self) {
        // SAFETY: the handle is this object's alone.
        unsafe { sys::locus_pmq_destroy(self.handle.as_ptr()) }
    }
}

/// A closure that is shown records during one call.
pub(crate) struct Call<'c, R, T> {
    pub(crate) gate: &'c Gate,
    pub(crate) closure: &'c mut dyn FnMut(&R) -> T,
    pub(crate) otherwise: T,
}

impl<R, T> Call<'_, R, T> {
    pub(crate) fn user(&mut self) -> *mut c_void {
        self as *mut Self as *mut c_void
    }
}

pub(crate) unsafe extern "C" fn call_at<R: Record, T: Copy>(record: *const c_void, user: *mut c_void) -> T {
    let call = &mut *(user as *mut Call<'_, R, T>);
    let closure = &mut call.closure;
    guard(call.gate, call.otherwise, || closure(&*(record as *const R)))
}

fn bins(log2_bins: u32) -> usize {
    if log2_bins <= 8 {
        1 << (2 * log2_bins)
    } else {
        0
    }
}

fn room<T: Clone + Default>(count: usize) -> Result<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(count).map_err(|_| Error::Memory(format!("no memory for {count} records")))?;
    list.resize(count, T::default());
    Ok(list)
}
