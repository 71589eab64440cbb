use crate::callback::{guard, Gate};
use crate::error::{check, listed};
use crate::store::Shared;
use crate::{sys, Error, Point32, Query, Record, Result, Store};
use std::collections::HashMap;
use std::os::raw::c_void;
use std::ptr::NonNull;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// A region that stands out.
pub use sys::locus_alert as Alert;
/// The statistics of alerts.
pub use sys::locus_alerts_stats as AlertsStats;

type Told = Box<dyn FnMut(&Alert) -> bool + Send>;
type Shown<R> = Box<dyn FnMut(u64, &R) -> bool + Send>;

/// When a region stands out, and who is told: `locus_alerts_options` in `locus/alerts.h`.
pub struct AlertsOptions<R: Record = Point32> {
    plain: sys::locus_alerts_options,
    alert: Option<Told>,
    fence: Option<Shown<R>>,
}

impl<R: Record> Default for AlertsOptions<R> {
    fn default() -> Self {
        Self { plain: defaults!(locus_alerts_options, locus_alerts_options_init), alert: None, fence: None }
    }
}

impl<R: Record> AlertsOptions<R> {
    setters! {
        /// The coarsest regions that are reported; default 5.
        zoom_from: u32;
        /// The finest; default 12.
        zoom_to: u32;
        /// Of the present, microseconds; default 5 minutes.
        half_life: i64;
        /// Half life of the history, microseconds; default 1 hour.
        history: i64;
        /// Microseconds; default 30 minutes.
        cool_down: i64;
        /// Records; default 20.
        minimum: f64;
        /// Of a jump; default 4.
        factor: f64;
        /// Records a second; default: none.
        rate: f64;
        /// Part of all that arrives; default: none.
        share: f64;
        /// Most memory of the quadtree.
        max_bytes: u64;
    }

    /// Told of a region, once; false stops. It may ask the store, not change it.
    #[must_use]
    pub fn alert(mut self, alert: impl FnMut(&Alert) -> bool + Send + 'static) -> Self {
        self.alert = Some(Box::new(alert));
        self
    }

    /// Shown a record that arrives inside a fence; false stops. It may ask the store, not change it.
    #[must_use]
    pub fn fence(mut self, fence: impl FnMut(u64, &R) -> bool + Send + 'static) -> Self {
        self.fence = Some(Box::new(fence));
        self
    }
}

/// The filter of a fence, which an insert may be asking while the fence is removed.
struct Filter<R> {
    accepts: Box<dyn Fn(&R) -> bool + Send + Sync>,
    store: Arc<Shared<R>>,
}

struct Inner<R: Record> {
    handle: NonNull<sys::locus_alerts>,
    callbacks: Box<Callbacks<R>>,
    filters: Mutex<HashMap<u64, Box<Filter<R>>>>,
}

struct Callbacks<R> {
    alert: Mutex<Option<Told>>,
    fence: Mutex<Option<Shown<R>>>,
    ended: AtomicBool,
    gate: Gate,
}

// SAFETY: calls may run beside each other and beside an insert; ending waits for that. Closures are Send.
unsafe impl<R: Record> Send for Inner<R> {}
unsafe impl<R: Record> Sync for Inner<R> {}

impl<R: Record> Drop for Inner<R> {
    fn drop(&mut self) {
        // SAFETY: the handle is this object's alone, and no other thread inserts.
        unsafe { sys::locus_alerts_destroy(self.handle.as_ptr()) }
    }
}

unsafe extern "C" fn alert_at<R: Record>(alert: *const Alert, user: *mut c_void) -> i32 {
    let callbacks = &*(user as *const Callbacks<R>);
    tell(callbacks, &callbacks.alert, |told| told(&*alert))
}

unsafe extern "C" fn fence_at<R: Record>(fence: u64, record: *const c_void, user: *mut c_void) -> i32 {
    let callbacks = &*(user as *const Callbacks<R>);
    tell(callbacks, &callbacks.fence, |shown| shown(fence, &*(record as *const R)))
}

fn tell<R, F>(callbacks: &Callbacks<R>, closure: &Mutex<Option<F>>, call: impl FnOnce(&mut F) -> bool) -> i32 {
    if callbacks.ended.load(Ordering::Relaxed) {
        return 0;
    }
    guard(&callbacks.gate, 1, || match closure.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
        Some(closure) => i32::from(!call(closure)),
        None => 0,
    })
}

unsafe extern "C" fn accepts_at<R: Record>(record: *const c_void, user: *mut c_void) -> i32 {
    let filter = &*(user as *const Filter<R>);
    guard(&filter.store.gate, 0, || i32::from((filter.accepts)(&*(record as *const R))))
}

/// Watches what is inserted into a store: regions where far more arrives than before, and fences.
///
/// It ends when it is dropped, after an insert that another thread is in; within its own callback at the insert's end.
///
/// ```
/// use locus::{Alerts, AlertsOptions, Circle, Point32, Query, Store, StoreOptions};
/// use std::sync::mpsc::channel;
/// # fn main() -> locus::Result<()> {
/// let store = Store::new(StoreOptions::default())?;
/// let (sender, inside) = channel();
/// let options = AlertsOptions::default().fence(move |fence, record: &Point32| sender.send((fence, record.device)).is_ok());
/// let alerts = Alerts::new(&store, options)?;
/// let louvre = Circle { latitude: 48.8606, longitude: 2.3376, radius: 500.0 };
/// alerts.add_fence(1, &Query::new().circle(louvre))?;
/// store.insert(&[Point32 { latitude: 48.861, longitude: 2.337, device: 7, ..Point32::default() }], 0)?;
/// assert_eq!(inside.try_recv(), Ok((1, 7)));
/// # Ok(()) }
/// ```
pub struct Alerts<R: Record = Point32> {
    inner: Option<Box<Inner<R>>>,
    store: Arc<Shared<R>>,
}

impl<R: Record> Alerts<R> {
    /// Watch a store from now on.
    pub fn new(store: &Store<R>, options: AlertsOptions<R>) -> Result<Self> {
        store.outside()?;
        let shared = store.shared().clone();
        let writing = shared.write(true)?;
        let AlertsOptions { mut plain, alert, fence } = options;
        let (told, shown) = (alert.is_some(), fence.is_some());
        let (alert, fence) = (Mutex::new(alert), Mutex::new(fence));
        let callbacks = Box::new(Callbacks { alert, fence, ended: AtomicBool::new(false), gate: Gate::default() });
        let user = &*callbacks as *const Callbacks<R> as *mut c_void;
        if told {
            plain.alert = Some(alert_at::<R>);
            plain.alert_user = user;
        }
        if shown {
            plain.fence = Some(fence_at::<R>);
            plain.fence_user = user;
        }
        let mut made = std::ptr::null_mut();
        // SAFETY: the closures live until the handle has ended.
        check(unsafe { sys::locus_alerts_create(store.raw(), &plain, &mut made) })?;
        let handle = NonNull::new(made).ok_or_else(|| Error::Internal("the alerts were not made".into()))?;
        drop(writing);
        let inner = Inner { handle, callbacks, filters: Mutex::default() };
        Ok(Self { inner: Some(Box::new(inner)), store: shared })
    }

    fn inner(&self) -> &Inner<R> {
        self.inner.as_ref().expect("is there until it is dropped")
    }

    /// The active alerts, the latest first.
    pub fn active(&self) -> Result<Vec<Alert>> {
        // SAFETY: there is room for as many as said.
        listed(|into, capacity, count| unsafe { sys::locus_alerts_active(self.inner().handle.as_ptr(), into, capacity, count) })
    }

    /// Add a fence under an id of yours: the region and times of a query without a filter.
    pub fn add_fence(&self, id: u64, query: &Query<'_, R>) -> Result<()> {
        if query.filter.is_some() {
            return Err(Error::Argument("Alerts::add_fence: the query has a filter; give it to add_fence_where".into()));
        }
        // SAFETY: the query is copied.
        check(unsafe { sys::locus_alerts_add_fence(self.inner().handle.as_ptr(), id, &query.plain()) })
    }

    /// The same, only for records that the closure says true to. It must not call into the store.
    pub fn add_fence_where(
        &self,
        id: u64,
        query: &Query<'_, R>,
        filter: impl Fn(&R) -> bool + Send + Sync + 'static,
    ) -> Result<()> {
        if query.filter.is_some() {
            return Err(Error::Argument("Alerts::add_fence_where: the query has a filter, too".into()));
        }
        let filter = Box::new(Filter { accepts: Box::new(filter), store: self.store.clone() });
        let mut plain = query.plain();
        plain.filter = Some(accepts_at::<R>);
        plain.filter_user = &*filter as *const Filter<R> as *mut c_void;
        let mut filters = self.inner().filters.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: the filter lives until the fence has been removed and no insert can ask it.
        check(unsafe { sys::locus_alerts_add_fence(self.inner().handle.as_ptr(), id, &plain) })?;
        filters.insert(id, filter);
        Ok(())
    }

    /// Remove a fence.
    pub fn remove_fence(&self, id: u64) -> Result<()> {
        let filter = {
            let mut filters = self.inner().filters.lock().unwrap_or_else(PoisonError::into_inner);
            // SAFETY: the handle is alive.
            check(unsafe { sys::locus_alerts_remove_fence(self.inner().handle.as_ptr(), id) })?;
            filters.remove(&id)
        };
        if let Some(filter) = filter {
            self.store.end(filter);
        }
        Ok(())
    }

    /// The statistics.
    pub fn stats(&self) -> Result<AlertsStats> {
        let mut stats = sized!(locus_alerts_stats);
        // SAFETY: the handle is alive.
        check(unsafe { sys::locus_alerts_get_stats(self.inner().handle.as_ptr(), &mut stats) })?;
        Ok(stats)
    }
}

impl<R: Record> Drop for Alerts<R> {
    fn drop(&mut self) {
        if let Some(inner) = self.inner.take() {
            inner.callbacks.ended.store(true, Ordering::Relaxed);
            self.store.end(inner);
        }
    }
}
