use crate::callback::{panicked, progress_at, Gate, Progress};
use crate::error::check;
use crate::{sys, Error, Record, Result, Snapshot, Store, StoreOptions};
use std::ffi::CString;
use std::os::raw::c_void;
use std::os::unix::ffi::OsStrExt;
use std::path::Path;

/// What a saved file says of itself.
pub use sys::locus_pmq_file_info as FileInfo;
/// The figures of a log.
pub use sys::locus_pmq_log_stats as LogStats;
/// What [`Store::open`] found.
pub use sys::locus_pmq_recovery as Recovery;

constants! {
    /// When the log is flushed to the disk.
    Sync {
        /// when the operating system sees fit
        None = LOCUS_SYNC_NONE,
        /// before every change returns
        Batch = LOCUS_SYNC_BATCH,
        /// after `sync_interval` or `sync_bytes`
        Interval = LOCUS_SYNC_INTERVAL,
    }
}

/// How to log: `locus_pmq_log_options` in `locus/storage.h`.
#[derive(Clone)]
pub struct LogOptions {
    plain: sys::locus_pmq_log_options,
}

impl Default for LogOptions {
    fn default() -> Self {
        Self { plain: defaults!(locus_pmq_log_options, locus_pmq_log_options_init) }
    }
}

impl LogOptions {
    setters! {
        /// Default [`Sync::Batch`].
        sync: Sync => u32::from;
        /// Hand over again at recovery what left since the last save; default yes.
        redeliver: bool => u32::from;
        /// Microseconds; default 1 s.
        sync_interval: i64;
        /// Bytes; default 16 MiB.
        sync_bytes: u64;
        /// Saved generations to keep beside the newest; default 1.
        keep: u32;
        /// Cut a log that is damaged in the middle; default no.
        repair: bool => u32::from;
    }
}

pub(crate) fn path_text(path: &Path) -> Result<CString> {
    CString::new(path.as_os_str().as_bytes()).map_err(|_| Error::Argument(format!("the path {path:?} holds a NUL")))
}

/// Make a call with a progress closure.
fn with_progress(
    gate: &Gate,
    mut progress: impl FnMut(f64) -> bool,
    call: impl FnOnce(sys::locus_progress_fn, *mut c_void) -> i32,
) -> i32 {
    let mut told = Progress { owner: gate, stop: &panicked, told: &mut progress };
    call(Some(progress_at), told.user())
}

/// Stores on disk. Progress closures are told the fraction done; false cancels, which is [`Error::Stopped`].
///
/// ```
/// use locus::{LogOptions, Point32, Query, Store, StoreOptions};
/// # fn main() -> locus::Result<()> {
/// let folder = std::env::temp_dir().join(format!("locus-doctest-{}", std::process::id()));
/// {
///     let (store, found) = Store::open(&folder, StoreOptions::default(), &LogOptions::default(), |_| true)?;
///     assert_eq!(found.created, 1);
///     store.insert(&[Point32::default()], 0)?;
/// }
/// let (store, found) = Store::<Point32>::open(&folder, StoreOptions::default(), &LogOptions::default(), |_| true)?;
/// assert_eq!((found.created, store.count(&Query::new())?), (0, 1));
/// # drop(store);
/// # std::fs::remove_dir_all(&folder).unwrap();
/// # Ok(()) }
/// ```
impl<R: Record> Store<R> {
    /// Save the store, or a snapshot of it, as a file, atomically.
    pub fn save(&self, path: impl AsRef<Path>, snapshot: Option<&Snapshot>, progress: impl FnMut(f64) -> bool) -> Result<()> {
        let (gate, path) = (self.outside()?, path_text(path.as_ref())?);
        let moment = snapshot.map_or(std::ptr::null(), Snapshot::raw);
        // SAFETY: path and closure outlive the call.
        check(with_progress(gate, progress, |at, user| unsafe {
            sys::locus_pmq_save(self.raw(), moment, path.as_ptr(), at, user)
        }))
    }

    /// Make a store from a saved file.
    pub fn load(path: impl AsRef<Path>, options: StoreOptions<R>, progress: impl FnMut(f64) -> bool) -> Result<Self> {
        let path = path_text(path.as_ref())?;
        // SAFETY: path and closure outlive the call.
        Self::make(options, |gate, plain, made| {
            with_progress(gate, progress, |at, user| unsafe { sys::locus_pmq_load(path.as_ptr(), plain, at, user, made) })
        })
    }

    /// Recover the store of a folder, or make a new one, and log every change from now on.
    pub fn open(
        folder: impl AsRef<Path>,
        options: StoreOptions<R>,
        log: &LogOptions,
        progress: impl FnMut(f64) -> bool,
    ) -> Result<(Self, Recovery)> {
        let folder = path_text(folder.as_ref())?;
        let mut recovery = sized!(locus_pmq_recovery);
        // SAFETY: folder and closure outlive the call.
        let store = Self::make(options, |gate, plain, made| {
            with_progress(gate, progress, |at, user| unsafe {
                sys::locus_pmq_open(folder.as_ptr(), plain, &log.plain, at, user, &mut recovery, made)
            })
        })?;
        Ok((store, recovery))
    }

    /// Give a store that has no log a folder that has no store.
    pub fn attach(&self, folder: impl AsRef<Path>, log: &LogOptions, progress: impl FnMut(f64) -> bool) -> Result<()> {
        let (gate, folder) = (self.outside()?, path_text(folder.as_ref())?);
        // SAFETY: folder and closure outlive the call.
        check(with_progress(gate, progress, |at, user| unsafe {
            sys::locus_pmq_attach(self.raw(), folder.as_ptr(), &log.plain, at, user)
        }))
    }

    /// Save into the store's folder and begin a new log.
    pub fn checkpoint(&self, progress: impl FnMut(f64) -> bool) -> Result<()> {
        let gate = self.outside()?;
        // SAFETY: the closure outlives the call.
        check(with_progress(gate, progress, |at, user| unsafe { sys::locus_pmq_checkpoint(self.raw(), at, user) }))
    }

    /// Flush the log to the disk.
    pub fn sync(&self) -> Result<()> {
        self.outside()?;
        // SAFETY: the handle is alive.
        check(unsafe { sys::locus_pmq_sync(self.raw()) })
    }

    /// The figures of the log.
    pub fn log_stats(&self) -> Result<LogStats> {
        self.outside()?;
        let mut stats = sized!(locus_pmq_log_stats);
        // SAFETY: the handle is alive.
        check(unsafe { sys::locus_pmq_get_log_stats(self.raw(), &mut stats) })?;
        Ok(stats)
    }
}

/// Read a saved file's header.
pub fn file_info(path: impl AsRef<Path>) -> Result<FileInfo> {
    let path = path_text(path.as_ref())?;
    let mut info = sized!(locus_pmq_file_info);
    // SAFETY: the path outlives the call.
    check(unsafe { sys::locus_pmq_get_file_info(path.as_ptr(), &mut info) })?;
    Ok(info)
}
