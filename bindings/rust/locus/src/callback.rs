//! Closures as callbacks of the C interface: a panic is kept until the C call has returned, and goes on there; and what a
//! callback must not call returns [`Error::Busy`].
use crate::{Error, Result};
use std::any::Any;
use std::cell::{Cell, RefCell};
use std::ffi::CStr;
use std::os::raw::{c_char, c_void};
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicIsize, Ordering};

thread_local! {
    static PANIC: Cell<Option<Box<dyn Any + Send>>> = Cell::new(None);
    /// The objects whose callbacks this thread is in.
    static INSIDE: RefCell<Vec<usize>> = RefCell::new(Vec::new());
}

/// A line for people: a level (10 debug, 20 info, 30 warning) and its text.
pub type Log = Box<dyn Fn(i32, &str) + Send + Sync>;

/// Call a closure from a callback of `owner`; after a panic in this call, and in it, the answer is `otherwise`.
pub(crate) fn guard<T>(owner: &Gate, otherwise: T, body: impl FnOnce() -> T) -> T {
    if panicked() {
        return otherwise;
    }
    match caught(owner, body) {
        Ok(value) => value,
        Err(payload) => {
            PANIC.with(|kept| kept.set(Some(payload)));
            otherwise
        }
    }
}

/// Call a closure from a callback of `owner`; what it panics with is the caller's to keep.
pub(crate) fn caught<T>(owner: &Gate, body: impl FnOnce() -> T) -> std::thread::Result<T> {
    INSIDE.with(|inside| inside.borrow_mut().push(owner.id()));
    let result = catch_unwind(AssertUnwindSafe(body));
    INSIDE.with(|inside| inside.borrow_mut().pop());
    result
}

/// Did a callback of this thread's call panic?
pub(crate) fn panicked() -> bool {
    PANIC.with(|kept| {
        let payload = kept.take();
        let some = payload.is_some();
        kept.set(payload);
        some
    })
}

/// Let a panic go on whose callback was called by the C call that has just returned.
pub(crate) fn resume() {
    if let Some(payload) = PANIC.with(Cell::take) {
        resume_unwind(payload);
    }
}

/// Who is inside the calls of an object: any number that share it, or one that has it alone.
#[derive(Default)]
pub(crate) struct Gate {
    inside: AtomicIsize, // -1: one that has it alone
}

pub(crate) struct Held<'g>(&'g Gate, isize);

impl Gate {
    fn id(&self) -> usize {
        self as *const Gate as usize
    }

    /// Refuse a call from within a callback of the object.
    pub(crate) fn outside(&self, what: &str) -> Result<()> {
        if INSIDE.with(|inside| inside.borrow().contains(&self.id())) {
            return Err(Error::Busy(format!("the {what} is at work, and this is its callback")));
        }
        Ok(())
    }

    pub(crate) fn shared(&self, what: &str) -> Result<Held<'_>> {
        self.outside(what)?;
        let enter = |inside: isize| if inside < 0 { None } else { Some(inside + 1) };
        self.inside
            .fetch_update(Ordering::Acquire, Ordering::Relaxed, enter)
            .map(|_| Held(self, -1))
            .map_err(|_| Error::Busy(format!("another thread changes the {what}")))
    }

    pub(crate) fn alone(&self, what: &str) -> Result<Held<'_>> {
        self.outside(what)?;
        self.inside
            .compare_exchange(0, -1, Ordering::Acquire, Ordering::Relaxed)
            .map(|_| Held(self, 1))
            .map_err(|_| Error::Busy(format!("another thread is inside a call on the {what}")))
    }
}

impl Drop for Held<'_> {
    fn drop(&mut self) {
        self.0.inside.fetch_add(self.1, Ordering::Release);
    }
}

/// A progress closure for one call.
pub(crate) struct Progress<'p> {
    pub(crate) owner: &'p Gate,
    pub(crate) stop: &'p dyn Fn() -> bool, // has another callback panicked?
    pub(crate) told: &'p mut dyn FnMut(f64) -> bool,
}

impl Progress<'_> {
    pub(crate) fn user(&mut self) -> *mut c_void {
        self as *mut Self as *mut c_void
    }
}

pub(crate) unsafe extern "C" fn progress_at(fraction: f64, user: *mut c_void) -> i32 {
    let progress = &mut *(user as *mut Progress<'_>);
    if (progress.stop)() {
        return 1;
    }
    let told = &mut progress.told;
    guard(progress.owner, 1, || i32::from(!told(fraction)))
}

/// What a log callback's `user` points to.
pub(crate) struct Logger {
    pub(crate) log: Log,
    pub(crate) owner: std::sync::Weak<dyn HasGate>,
}

/// What callbacks belong to.
pub(crate) trait HasGate: Send + Sync {
    fn gate(&self) -> &Gate;
}

pub(crate) unsafe extern "C" fn log_at(level: i32, text: *const c_char, user: *mut c_void) {
    let logger = &*(user as *const Logger);
    let text = CStr::from_ptr(text).to_string_lossy();
    if let Some(owner) = logger.owner.upgrade() {
        guard(owner.gate(), (), || (logger.log)(level, &text));
    }
}
