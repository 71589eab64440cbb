use crate::sys;
use std::ffi::CStr;
use std::fmt;
use std::os::raw::c_char;

/// A failed call: its status, with the library's text, which names the function, the argument and the offending value.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// An argument is out of its range or contradicts another one.
    Argument(String),
    /// A value cannot be represented in the words the object was created with.
    Range(String),
    /// The memory given is too small.
    Capacity(String),
    /// The object is not in a state that allows the call.
    State(String),
    /// Not available in this build or on this machine.
    Unsupported(String),
    /// A callback asked to stop.
    Stopped(String),
    /// Another thread is inside a call that excludes this one, or this is a callback of the same object.
    Busy(String),
    /// The snapshot outlived its memory budget.
    Stale(String),
    /// Out of memory.
    Memory(String),
    /// The operating system refused to read or write.
    Io(String),
    /// Bytes from outside are not what they claim to be.
    Format(String),
    /// The GPU or its driver reported an error.
    Device(String),
    /// A defect in Locus.
    Internal(String),
    /// A status that these bindings do not know.
    Other(i32, String),
}

/// What calls that can fail return.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    fn new(status: i32, text: String) -> Self {
        match status {
            sys::LOCUS_E_ARGUMENT => Error::Argument(text),
            sys::LOCUS_E_RANGE => Error::Range(text),
            sys::LOCUS_E_CAPACITY => Error::Capacity(text),
            sys::LOCUS_E_STATE => Error::State(text),
            sys::LOCUS_E_UNSUPPORTED => Error::Unsupported(text),
            sys::LOCUS_E_STOPPED => Error::Stopped(text),
            sys::LOCUS_E_BUSY => Error::Busy(text),
            sys::LOCUS_E_STALE => Error::Stale(text),
            sys::LOCUS_E_MEMORY => Error::Memory(text),
            sys::LOCUS_E_IO => Error::Io(text),
            sys::LOCUS_E_FORMAT => Error::Format(text),
            sys::LOCUS_E_DEVICE => Error::Device(text),
            sys::LOCUS_E_INTERNAL => Error::Internal(text),
            other => Error::Other(other, text),
        }
    }

    /// The number of the C interface, `LOCUS_E_`.
    pub fn status(&self) -> i32 {
        match self {
            Error::Argument(_) => sys::LOCUS_E_ARGUMENT,
            Error::Range(_) => sys::LOCUS_E_RANGE,
            Error::Capacity(_) => sys::LOCUS_E_CAPACITY,
            Error::State(_) => sys::LOCUS_E_STATE,
            Error::Unsupported(_) => sys::LOCUS_E_UNSUPPORTED,
            Error::Stopped(_) => sys::LOCUS_E_STOPPED,
            Error::Busy(_) => sys::LOCUS_E_BUSY,
            Error::Stale(_) => sys::LOCUS_E_STALE,
            Error::Memory(_) => sys::LOCUS_E_MEMORY,
            Error::Io(_) => sys::LOCUS_E_IO,
            Error::Format(_) => sys::LOCUS_E_FORMAT,
            Error::Device(_) => sys::LOCUS_E_DEVICE,
            Error::Internal(_) => sys::LOCUS_E_INTERNAL,
            Error::Other(status, _) => *status,
        }
    }

    /// The constant's name, such as `LOCUS_E_RANGE`.
    pub fn name(&self) -> &'static str {
        // SAFETY: the text is static.
        unsafe { text(sys::locus_status_name(self.status())) }
    }

    /// What went wrong.
    pub fn text(&self) -> &str {
        match self {
            Error::Argument(text) | Error::Range(text) | Error::Capacity(text) | Error::State(text) => text,
            Error::Unsupported(text) | Error::Stopped(text) | Error::Busy(text) | Error::Stale(text) => text,
            Error::Memory(text) | Error::Io(text) | Error::Format(text) | Error::Device(text) => text,
            Error::Internal(text) | Error::Other(_, text) => text,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "{} ({})", self.text(), self.name())
    }
}

impl std::error::Error for Error {}

/// A text of the library that is static.
unsafe fn text(pointer: *const c_char) -> &'static str {
    CStr::from_ptr(pointer).to_str().unwrap_or("")
}

/// The version of the library that is loaded: major * 10000 + minor * 100 + patch.
pub fn version() -> u32 {
    // SAFETY: takes nothing.
    unsafe { sys::locus_version() }
}

/// The version as text, and what was built in.
pub fn version_text() -> &'static str {
    // SAFETY: the text is static.
    unsafe { text(sys::locus_version_text()) }
}

/// What a call of liblocus came to; a panic of its callbacks goes on from here.
pub(crate) fn check(status: sys::locus_status) -> Result<()> {
    // SAFETY: the text stays valid until this thread's next failed call.
    settle(status, || unsafe { sys::locus_last_error() })
}

/// The same of a library that keeps its texts apart.
pub(crate) fn settle(status: sys::locus_status, last_error: impl FnOnce() -> *const c_char) -> Result<()> {
    crate::callback::resume();
    if status == sys::LOCUS_OK {
        return Ok(());
    }
    // SAFETY: the text is this thread's and has not changed since the call.
    let text = unsafe { CStr::from_ptr(last_error()) }.to_string_lossy().into_owned();
    Err(Error::new(status, text))
}

/// A list whose length the library tells: asked for without room first, then with what it needs.
pub(crate) fn listed<T: Clone + Default>(fill: impl FnMut(*mut T, usize, *mut usize) -> i32) -> Result<Vec<T>> {
    listed_by(check, fill)
}

/// The same of a library that keeps its texts apart.
pub(crate) fn listed_by<T: Clone + Default>(
    check: fn(sys::locus_status) -> Result<()>,
    mut fill: impl FnMut(*mut T, usize, *mut usize) -> i32,
) -> Result<Vec<T>> {
    let mut count = 0;
    let mut status = fill(std::ptr::null_mut(), 0, &mut count);
    let mut list = Vec::new();
    while status == sys::LOCUS_E_CAPACITY || (status == sys::LOCUS_OK && list.len() < count) {
        crate::callback::resume();
        list.resize(count, T::default());
        status = fill(list.as_mut_ptr(), list.len(), &mut count);
    }
    check(status)?;
    list.truncate(count);
    Ok(list)
}
