use crate::callback::Gate;
use crate::error::{listed_by, settle};
use crate::storage::path_text;
use crate::store::{call_at, Call, Tier};
use crate::{sys, Error, Point32, Query, Record, Result, Store, StoreOptions};
use std::marker::PhantomData;
use std::os::raw::c_void;
use std::path::Path;
use std::ptr::{null, null_mut, NonNull};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::Arc;

/// The statistics of a tier.
pub use sys::locus_cold_stats as ColdStats;

constants! {
    /// How a tier's file is made safe against loss of power.
    ColdSync {
        /// not: it may be damaged
        Off = LOCUS_COLD_SYNC_OFF,
        /// valid; transactions since a checkpoint or a flush may be missing
        Normal = LOCUS_COLD_SYNC_NORMAL,
        /// valid and complete
        Full = LOCUS_COLD_SYNC_FULL,
    }
    /// What a change of the store does while the queue is full.
    ColdFull {
        /// it waits for the database
        Wait = LOCUS_COLD_FULL_WAIT,
        /// it is [`Error::Stopped`], and the rest waits in the store
        Refuse = LOCUS_COLD_FULL_REFUSE,
    }
}

/// How to keep a tier: `locus_cold_options` in `locus/cold.h`.
#[derive(Clone)]
pub struct ColdOptions<R: Record = Point32> {
    plain: sys::locus_cold_options,
    record: PhantomData<R>,
}

impl<R: Record> Default for ColdOptions<R> {
    fn default() -> Self {
        let mut plain = defaults!(locus_cold_options, locus_cold_options_init);
        plain.record = R::KIND;
        Self { plain, record: PhantomData }
    }
}

impl<R: Record> ColdOptions<R> {
    setters! {
        /// Default [`ColdSync::Normal`].
        sync: ColdSync => u32::from;
        /// Default [`ColdFull::Wait`].
        when_full: ColdFull => u32::from;
        /// Bytes of records in memory; default 64 MiB.
        queue_bytes: u64;
        /// A transaction begins when so many wait, and takes no more; default 262,144.
        batch_records: u64;
        /// Microseconds that fewer may wait; default 1 s.
        delay: i64;
        /// A run ends once it has so many; default 1,048,576.
        run_records: u64;
        /// Of the writer's page cache, bytes; default 64 MiB.
        cache_bytes: u64;
        /// Microseconds a record is kept, see [`Cold::sweep`]; default: no limit.
        max_age: i64;
        /// Pages in use in the file, bytes; beyond, what came first goes; default: no limit.
        max_bytes: u64;
    }
}

/// What a call of liblocus_cold came to.
fn check(status: sys::locus_status) -> Result<()> {
    // SAFETY: the text stays valid until this thread's next failed call.
    settle(status, || unsafe { sys::locus_cold_last_error() })
}

struct Inner {
    handle: NonNull<sys::locus_cold>,
    gate: Gate, // shared by questions; attaching and rewinding have it alone
    attached: AtomicBool,
}

// SAFETY: any thread may ask; what stands alone has the gate alone; and it ends behind its store and all calls.
unsafe impl Send for Inner {}
unsafe impl Sync for Inner {}

impl Inner {
    fn raw(&self) -> *mut sys::locus_cold {
        self.handle.as_ptr()
    }
}

impl Tier for Inner {
    fn attach(&self, options: &mut sys::locus_pmq_options) -> Result<()> {
        let _alone = self.gate.alone("cold tier")?;
        if self.attached.swap(true, Ordering::AcqRel) {
            return Err(Error::State("another store is attached to the cold tier".into()));
        }
        // SAFETY: the handle is alive, and no other call is at work that this excludes.
        let done = check(unsafe { sys::locus_cold_attach(self.raw(), options) });
        if done.is_err() {
            self.detach();
        }
        done
    }

    fn detach(&self) {
        self.attached.store(false, Ordering::Release);
    }

    fn outside(&self) -> Result<()> {
        self.gate.outside("cold tier")
    }
}

impl Drop for Inner {
    fn drop(&mut self) {
        // SAFETY: the handle is this object's alone, and its store has ended.
        unsafe { sys::locus_cold_close(self.raw()) }
    }
}

/// A database that takes over what leaves a store, in the background, and answers together with it: each record that was
/// inserted, and that retention has not removed, is in an answer once. With the feature `cold`.
///
/// Any number of threads may ask. The tier closes, and writes what is queued, when it and its store are dropped;
/// [`Cold::flush`] first to learn of failures.
///
/// ```
/// use locus::{Cold, ColdOptions, Point32, Query, Store, StoreOptions};
/// # fn main() -> locus::Result<()> {
/// # let folder = std::env::temp_dir().join(format!("locus-doctest-cold-{}", std::process::id()));
/// # std::fs::create_dir_all(&folder).unwrap();
/// # let path = folder.join("posts.db");
/// let hour = 3_600_000_000;
/// let cold = Cold::open(&path, &ColdOptions::default().max_age(30 * 24 * hour))?;
/// let store = Store::new(StoreOptions::default().horizon(hour).cold(&cold))?;
/// for time in (0..48).map(|number| number * hour) {
///     store.insert(&[Point32 { time, ..Point32::default() }], time)?;
/// }
/// assert_eq!(store.count(&Query::new())?, 2);
/// assert_eq!(cold.count(Some(&store), &Query::new())?, 48);
/// assert_eq!(cold.read(Some(&store), &Query::new().between(0, 24 * hour))?.len(), 25);
/// # drop((store, cold));
/// # std::fs::remove_dir_all(&folder).unwrap();
/// # Ok(()) }
/// ```
///
/// The records of the store are those of the tier:
///
/// ```compile_fail
/// # use locus::{Cold, ColdOptions, Point32, Query, Store, StoreOptions, Text156};
/// let cold = Cold::<Text156>::open("posts.db", &ColdOptions::default()).unwrap();
/// Store::<Point32>::new(StoreOptions::default().cold(&cold));
/// ```
pub struct Cold<R: Record = Point32> {
    inner: Arc<Inner>,
    record: PhantomData<fn(R)>,
}

impl<R: Record> StoreOptions<R> {
    /// Let a tier take over, instead of a sink, the records that left; of one store at a time.
    #[must_use]
    pub fn cold(mut self, cold: &Cold<R>) -> Self {
        self.tier = Some(cold.inner.clone());
        self
    }
}

impl<R: Record> Cold<R> {
    /// Open the database, or make it. One tier at a time has it open.
    pub fn open(path: impl AsRef<Path>, options: &ColdOptions<R>) -> Result<Self> {
        let path = path_text(path.as_ref())?;
        let mut made = null_mut();
        // SAFETY: path and options outlive the call.
        check(unsafe { sys::locus_cold_open(path.as_ptr(), &options.plain, &mut made) })?;
        let handle = NonNull::new(made).ok_or_else(|| Error::Internal("the cold tier was not made".into()))?;
        let inner = Inner { handle, gate: Gate::default(), attached: AtomicBool::new(false) };
        Ok(Self { inner: Arc::new(inner), record: PhantomData })
    }

    /// Make a question: `call` is given the store's handle and the query.
    fn ask<T>(&self, store: Option<&Store<R>>, call: impl FnOnce(&Gate, *const sys::locus_pmq) -> Result<T>) -> Result<T> {
        let _shared = self.inner.gate.shared("cold tier")?;
        if let Some(store) = store {
            store.outside()?;
            if !store.attached_to(Arc::as_ptr(&self.inner) as *const ()) {
                return Err(Error::Argument("the store was made without this cold tier".into()));
            }
        }
        call(&self.inner.gate, store.map_or(null(), |store| store.raw() as *const _))
    }

    /// How many records a query selects in the store and in the tier, as of one moment; without a store, in the tier.
    pub fn count(&self, store: Option<&Store<R>>, query: &Query<'_, R>) -> Result<u64> {
        self.ask(store, |gate, pmq| {
            let mut count = 0;
            // SAFETY: the handles are alive.
            check(query.status(gate, |plain| unsafe { sys::locus_cold_count(self.inner.raw(), pmq, plain, &mut count) }))?;
            Ok(count)
        })
    }

    /// Those records, in the store's order, and those of one place as they came.
    pub fn read(&self, store: Option<&Store<R>>, query: &Query<'_, R>) -> Result<Vec<R>> {
        let raw = self.inner.raw();
        // SAFETY: there is room for as many records as said.
        self.ask(store, |gate, pmq| {
            listed_by(check, |into, capacity, count| {
                query.status(gate, |plain| unsafe { sys::locus_cold_read(raw, pmq, plain, into as *mut c_void, capacity, count) })
            })
        })
    }

    /// Show them to a closure, with bounded memory; false stops, which is [`Error::Stopped`]. It must not call into the
    /// tier or the store: that is [`Error::Busy`].
    pub fn visit(&self, store: Option<&Store<R>>, query: &Query<'_, R>, mut visitor: impl FnMut(&R) -> bool) -> Result<()> {
        self.ask(store, |gate, pmq| {
            let mut call = Call { gate, closure: &mut |record: &R| i32::from(!visitor(record)), otherwise: 1 };
            let (at, user) = (Some(call_at::<R, i32> as unsafe extern "C" fn(_, _) -> _), call.user());
            // SAFETY: the closure outlives the call.
            check(query.status(gate, |plain| unsafe { sys::locus_cold_visit(self.inner.raw(), pmq, plain, at, user) }))
        })
    }

    /// A call beside questions.
    fn plain(&self, call: impl FnOnce(*mut sys::locus_cold) -> i32) -> Result<()> {
        self.inner.outside()?;
        check(call(self.inner.raw()))
    }

    /// Wait until what has left the store by now is in the file. Records that cannot be written, as on a full disk, stay
    /// queued.
    pub fn flush(&self) -> Result<()> {
        // SAFETY: the handle is alive.
        self.plain(|raw| unsafe { sys::locus_cold_flush(raw) })
    }

    /// Set the tier's clock, which never runs back: records older than `max_age` are in no answer any more, and are
    /// removed.
    pub fn sweep(&self, now: i64) -> Result<()> {
        // SAFETY: the handle is alive.
        self.plain(|raw| unsafe { sys::locus_cold_sweep(raw, now) })
    }

    /// Forget what was taken over when `stats.received` had been `received` or more: for a store that was loaded again.
    pub fn rewind(&self, received: u64) -> Result<()> {
        let _alone = self.inner.gate.alone("cold tier")?;
        // SAFETY: the handle is alive, and no question is at work.
        check(unsafe { sys::locus_cold_rewind(self.inner.raw(), received) })
    }

    /// The statistics.
    pub fn stats(&self) -> Result<ColdStats> {
        let mut stats = sized!(locus_cold_stats);
        // SAFETY: the handle is alive.
        self.plain(|raw| unsafe { sys::locus_cold_get_stats(raw, &mut stats) })?;
        Ok(stats)
    }

    /// Verify the whole file.
    pub fn check(&self) -> Result<()> {
        // SAFETY: the handle is alive.
        self.plain(|raw| unsafe { sys::locus_cold_check(raw) })
    }
}
