use crate::callback::{guard, Gate};
use crate::error::check;
use crate::{sys, Record, Result, Snapshot};
use std::marker::PhantomData;
use std::os::raw::c_void;

/// A box in degrees, borders included; west > east: across the antimeridian.
pub use sys::locus_box as GeoBox;
/// The places at most `radius` metres from a centre.
pub use sys::locus_circle as Circle;
/// A place in the store's order, for [`crate::Store::read_page`].
pub use sys::locus_pmq_cursor as Cursor;
/// Records of one group.
pub use sys::locus_pmq_group as Group;
/// A record of 32 bytes.
pub use sys::locus_point32 as Point32;
/// A vertex of a polygon.
pub use sys::locus_position as Position;
/// A record of 156 bytes with a text.
pub use sys::locus_text156 as Text156;

constants! {
    /// An id field of [`Point32`].
    Field {
        /// `device`
        Device = LOCUS_FIELD_DEVICE,
        /// `application`
        Application = LOCUS_FIELD_APPLICATION,
        /// `language`
        Language = LOCUS_FIELD_LANGUAGE,
    }
}

type Filter<'q, R> = Box<dyn Fn(&R) -> bool + 'q>;

/// What to look for: everything, until it is narrowed.
///
/// ```
/// use locus::{GeoBox, Point32, Query};
/// let paris = GeoBox { south: 48.0, west: 2.0, north: 49.0, east: 3.0 };
/// let query = Query::<Point32>::new().within(paris).between(0, 3_600_000_000).filter(|record| record.device == 7);
/// ```
pub struct Query<'q, R: Record = Point32> {
    plain: sys::locus_pmq_query,
    vertices: Vec<Position>,
    ring_sizes: Vec<u64>,
    pub(crate) filter: Option<Filter<'q, R>>,
    snapshot: PhantomData<&'q Snapshot>,
}

impl<R: Record> Default for Query<'_, R> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'q, R: Record> Query<'q, R> {
    /// Everything.
    pub fn new() -> Self {
        let plain = defaults!(locus_pmq_query, locus_pmq_query_init);
        Self { plain, vertices: Vec::new(), ring_sizes: Vec::new(), filter: None, snapshot: PhantomData }
    }

    /// In a box.
    #[must_use]
    pub fn within(mut self, area: GeoBox) -> Self {
        self.plain.region = sys::LOCUS_REGION_BOX;
        self.plain.r#box = area;
        self
    }

    /// In a circle on the globe.
    #[must_use]
    pub fn circle(mut self, circle: Circle) -> Self {
        self.plain.region = sys::LOCUS_REGION_CIRCLE;
        self.plain.circle = circle;
        self
    }

    /// In a polygon of rings, by the even-odd rule.
    #[must_use]
    pub fn polygon<P: AsRef<[Position]>>(mut self, rings: impl IntoIterator<Item = P>) -> Self {
        self.plain.region = sys::LOCUS_REGION_POLYGON;
        self.vertices.clear();
        self.ring_sizes.clear();
        for ring in rings {
            self.vertices.extend_from_slice(ring.as_ref());
            self.ring_sizes.push(ring.as_ref().len() as u64);
        }
        self
    }

    /// With times from `from` to `to`, microseconds, both included.
    #[must_use]
    pub fn between(mut self, from: i64, to: i64) -> Self {
        self.plain.time_from = from;
        self.plain.time_to = to;
        self
    }

    /// Only records that the closure says true to. It must not ask the store: that is [`crate::Error::Busy`].
    #[must_use]
    pub fn filter(mut self, filter: impl Fn(&R) -> bool + 'q) -> Self {
        self.filter = Some(Box::new(filter));
        self
    }

    /// Records that have expired and have not left the store yet, too. Not for [`crate::Store::erase`].
    #[must_use]
    pub fn expired(mut self) -> Self {
        self.plain.expired = 1;
        self
    }

    /// Records need not come in the store's order, which is quicker.
    #[must_use]
    pub fn in_any_order(mut self) -> Self {
        self.plain.order = sys::LOCUS_ORDER_ANY;
        self
    }

    /// Of a snapshot of the store instead of the present.
    #[must_use]
    pub fn at(mut self, snapshot: &'q Snapshot) -> Self {
        self.plain.snapshot = snapshot.raw();
        self
    }

    /// The query without its filter, as long as `self` stays where it is.
    pub(crate) fn plain(&self) -> sys::locus_pmq_query {
        let mut plain = self.plain;
        plain.polygon.vertices = self.vertices.as_ptr();
        plain.polygon.ring_sizes = self.ring_sizes.as_ptr();
        plain.polygon.rings = self.ring_sizes.len() as u64;
        plain
    }

    /// Make a call with the query.
    pub(crate) fn ask(&self, gate: &Gate, call: impl FnOnce(*const sys::locus_pmq_query) -> i32) -> Result<()> {
        check(self.status(gate, call))
    }

    pub(crate) fn status(&self, gate: &Gate, call: impl FnOnce(*const sys::locus_pmq_query) -> i32) -> i32 {
        let mut plain = self.plain();
        let asked = self.filter.as_deref().map(|filter| Asked { filter, gate });
        if let Some(asked) = &asked {
            plain.filter = Some(filter_at::<R>);
            plain.filter_user = asked as *const Asked<'_, R> as *mut c_void;
        }
        call(&plain)
    }
}

struct Asked<'a, R> {
    filter: &'a (dyn Fn(&R) -> bool + 'a),
    gate: &'a Gate,
}

unsafe extern "C" fn filter_at<R: Record>(record: *const c_void, user: *mut c_void) -> i32 {
    let asked = &*(user as *const Asked<'_, R>);
    guard(asked.gate, 0, || i32::from((asked.filter)(&*(record as *const R))))
}

/// What makes a record good for [`crate::Store::topk`]: near to a place, and young.
#[derive(Clone, Debug)]
pub struct Score {
    pub(crate) plain: sys::locus_pmq_score,
}

impl Score {
    /// The defaults at a place.
    pub fn new(latitude: f64, longitude: f64) -> Self {
        let mut plain = defaults!(locus_pmq_score, locus_pmq_score_init);
        plain.latitude = latitude;
        plain.longitude = longitude;
        Self { plain }
    }

    setters! {
        /// Metres; default 30,000.
        radius: f64;
        /// Weight of the distance, 0..1; the age has the rest; default 0.2.
        alpha: f64;
        /// Microseconds; default 10,000 s.
        period: i64;
    }
}

/// The key of a place: the Morton code of its Web-Mercator tile at zoom 25.
pub fn key(latitude: f64, longitude: f64) -> Result<u64> {
    let mut key = 0;
    // SAFETY: the result has room.
    check(unsafe { sys::locus_pmq_key(latitude, longitude, &mut key) })?;
    Ok(key)
}
