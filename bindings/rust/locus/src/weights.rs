use crate::callback::{guard, Gate};
use crate::diagram::Handle;
use crate::graph::{box_at, Shared};
use crate::{sys, Diagram, Error, Result, VoxelBox};
use std::os::raw::c_void;
use std::ptr::NonNull;
use std::sync::{Arc, Mutex};

constants! {
    /// How weights are computed.
    Method {
        /// natural neighbours
        Sibson = LOCUS_METHOD_SIBSON,
        /// non-Sibsonian
        Laplace = LOCUS_METHOD_LAPLACE,
        /// the ratio of the distances to the seed and to its cell's border
        DistanceRatio = LOCUS_METHOD_DISTANCE_RATIO,
    }
}

type Told = Box<dyn FnMut(f64) -> bool + Send>;

/// How to compute weights: `locus_weights_options` in `locus/weights.h`.
pub struct WeightsOptions {
    plain: sys::locus_weights_options,
    told: Option<Told>,
}

impl Default for WeightsOptions {
    fn default() -> Self {
        Self { plain: defaults!(locus_weights_options, locus_weights_options_init), told: None }
    }
}

impl WeightsOptions {
    setters! {
        /// Default [`Method::Sibson`].
        method: Method => u32::from;
        /// Keep only so many largest weights of a row; default: all.
        max_per_row: u32;
        /// Most scratch memory of a call, bytes.
        batch_bytes: u64;
    }

    /// Be told the fraction done, by [`Weights::update`] too; false cancels.
    #[must_use]
    pub fn progress(mut self, progress: impl FnMut(f64) -> bool + Send + 'static) -> Self {
        self.told = Some(Box::new(progress));
        self
    }
}

/// Rows of weights: row i has the entries `offsets[i]..offsets[i + 1]`, by falling weight.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    /// one more than there are rows
    pub offsets: Vec<u64>,
    /// seed ids
    pub ids: Vec<u32>,
    /// weights, in (0, 1]
    pub values: Vec<f32>,
}

impl Rows {
    /// The seeds and weights of a row.
    pub fn row(&self, index: usize) -> impl Iterator<Item = (u32, f32)> + '_ {
        let entries = self.offsets[index] as usize..self.offsets[index + 1] as usize;
        self.ids[entries.clone()].iter().copied().zip(self.values[entries].iter().copied())
    }
}

/// What the progress callback needs as long as the weights live.
struct Kept {
    told: Mutex<Option<Told>>,
    gate: Gate,
    graph: Arc<Shared>,
}

unsafe extern "C" fn told_at(fraction: f64, user: *mut c_void) -> i32 {
    let kept = &*(user as *const Kept);
    if kept.graph.panicked() {
        return 1;
    }
    match kept.told.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).as_mut() {
        Some(told) => guard(&kept.gate, 1, || i32::from(!told(fraction))),
        None => 0,
    }
}

/// How much each seed of a diagram weighs at voxels. They stay usable when the diagram and its graph are dropped.
///
/// ```
/// # use locus::{Diagram, Graph, GraphOptions, Seed, Weights, WeightsOptions};
/// # fn main() -> locus::Result<()> {
/// # let graph = Graph::new(GraphOptions::new([5, 1, 1]), Some(&[1.0; 5]))?;
/// # let mut diagram = Diagram::new(&graph)?;
/// # diagram.add_seeds(&[Seed { id: 7, ..Seed::default() }, Seed { x: 4, id: 8, ..Seed::default() }])?;
/// # diagram.solve()?;
/// let weights = Weights::new(&mut diagram, WeightsOptions::default(), None)?;
/// let rows = weights.rows(0..5)?;
/// assert_eq!(rows.row(0).collect::<Vec<_>>(), [(7, 1.0)]);
/// for index in 0..5 {
///     assert!((rows.row(index).map(|(_, weight)| weight).sum::<f32>() - 1.0).abs() < 1e-5);
/// }
/// # Ok(()) }
/// ```
pub struct Weights {
    handle: NonNull<sys::locus_weights>,
    diagram: Arc<Handle>,
    kept: Box<Kept>,
    seeds: usize,
}

// SAFETY: as for Graph; the progress closure is only called by calls that have the weights alone.
unsafe impl Send for Weights {}
unsafe impl Sync for Weights {}

impl Weights {
    /// The rows of all voxels of a box (`None`: all), from a solved diagram.
    pub fn new(diagram: &mut Diagram, options: WeightsOptions, within: impl Into<Option<VoxelBox>>) -> Result<Self> {
        let within = within.into();
        // SAFETY: the box outlives the call.
        Self::make(diagram, options, |this, plain, made| unsafe { sys::locus_weights_create(this, plain, box_at(&within), made) })
    }

    /// The rows of a list of voxel indices.
    pub fn of(diagram: &mut Diagram, options: WeightsOptions, voxels: &[u64]) -> Result<Self> {
        // SAFETY: the list is as long as said.
        Self::make(diagram, options, |this, plain, made| unsafe {
            sys::locus_weights_create_for(this, plain, voxels.as_ptr(), voxels.len(), made)
        })
    }

    fn make(
        diagram: &mut Diagram,
        options: WeightsOptions,
        create: impl FnOnce(*mut sys::locus_diagram, *const sys::locus_weights_options, *mut *mut sys::locus_weights) -> i32,
    ) -> Result<Self> {
        let seeds = diagram.seeds()?.len(); // as long as nobody changes it: this call has it alone
        let graph = diagram.graph().clone();
        let _graph = graph.shared()?;
        let _held = diagram.handle().gate.alone("diagram")?;
        let mut plain = options.plain;
        let kept = Box::new(Kept { told: Mutex::new(options.told), gate: Gate::default(), graph: graph.clone() });
        plain.progress = Some(told_at);
        plain.progress_user = &*kept as *const Kept as *mut c_void;
        let mut made = std::ptr::null_mut();
        let status = create(diagram.raw(), &plain, &mut made);
        let weights = NonNull::new(made).map(|handle| Self { handle, diagram: diagram.handle().clone(), kept, seeds });
        graph.check(status)?;
        weights.ok_or_else(|| Error::Internal("the weights were not made".into()))
    }

    /// A call that reads the weights.
    fn ask(&self, call: impl FnOnce(*const sys::locus_weights) -> i32) -> Result<()> {
        let _graph = self.kept.graph.shared()?;
        let _held = self.kept.gate.shared("weights")?;
        self.kept.graph.check(call(self.handle.as_ptr()))
    }

    /// The number of rows, and of entries in all of them.
    pub fn size(&self) -> Result<(u64, u64)> {
        let (mut rows, mut entries) = (0, 0);
        // SAFETY: the handle is alive.
        self.ask(|this| unsafe { sys::locus_weights_size(this, &mut rows, &mut entries) })?;
        Ok((rows, entries))
    }

    /// The lengths of a range, which the library checks; room only for rows that are there.
    fn range(&self, rows: &std::ops::Range<u64>) -> Result<(u64, usize)> {
        let count = rows.end.saturating_sub(rows.start);
        Ok((count, count.min(self.size()?.0) as usize))
    }

    /// Some rows.
    pub fn rows(&self, rows: std::ops::Range<u64>) -> Result<Rows> {
        let (count, there) = self.range(&rows)?;
        let mut found = Rows { offsets: vec![0; there + 1], ..Rows::default() };
        if count != there as u64 {
            return Err(out_of_range("rows", &rows));
        }
        let mut entries = 0;
        // SAFETY: the offsets have room for count + 1 numbers, the others for none.
        let first = self.ask(|this| unsafe {
            let none = std::ptr::null_mut();
            sys::locus_weights_rows(
                this,
                rows.start,
                count,
                found.offsets.as_mut_ptr(),
                none,
                std::ptr::null_mut(),
                0,
                &mut entries,
            )
        });
        match first {
            Ok(()) | Err(Error::Capacity(_)) => {}
            Err(error) => return Err(error),
        }
        found.ids = vec![0; entries as usize];
        found.values = vec![0.0; entries as usize];
        // SAFETY: there is room for as many entries as said.
        self.ask(|this| unsafe {
            let (ids, values) = (found.ids.as_mut_ptr(), found.values.as_mut_ptr());
            sys::locus_weights_rows(
                this,
                rows.start,
                count,
                found.offsets.as_mut_ptr(),
                ids,
                values,
                found.ids.len(),
                &mut entries,
            )
        })?;
        Ok(found)
    }

    /// Some rows as dense lines: one number for each of these seeds, 0 where it weighs nothing.
    pub fn dense(&self, rows: std::ops::Range<u64>, ids: &[u32]) -> Result<Vec<f32>> {
        let (count, there) = self.range(&rows)?;
        let mut dense = vec![0.0; room(there, ids.len())?];
        // SAFETY: there is room for as many numbers as said.
        self.ask(|this| unsafe {
            sys::locus_weights_dense(this, rows.start, count, ids.as_ptr(), ids.len(), dense.as_mut_ptr(), dense.len())
        })?;
        Ok(dense)
    }

    /// Interpolate values given at the seeds, `components` numbers each, in the order of [`Diagram::seeds`] when the
    /// weights were made or updated; an empty row gives NaN.
    pub fn interpolate(&self, rows: std::ops::Range<u64>, values: &[f32], components: u32) -> Result<Vec<f32>> {
        if values.len() as u64 != self.seeds as u64 * u64::from(components) {
            let text = format!("Weights::interpolate: {} values for {} seeds of {components}", values.len(), self.seeds);
            return Err(Error::Argument(text));
        }
        let (count, there) = self.range(&rows)?;
        let mut out = vec![0.0; room(there, components as usize)?];
        // SAFETY: a line of values for each seed, and room for as many numbers as said.
        self.ask(|this| unsafe {
            let (first, room) = (rows.start, out.len());
            sys::locus_weights_interpolate(this, first, count, values.as_ptr(), components, out.as_mut_ptr(), room)
        })?;
        Ok(out)
    }

    /// The gradients of one seed's weight at rows of a box.
    pub fn gradients(&self, rows: std::ops::Range<u64>, id: u32) -> Result<Vec<[f32; 3]>> {
        let (count, there) = self.range(&rows)?;
        let mut found = vec![[0.0_f32; 3]; there];
        // SAFETY: there is room for as many numbers as said; arrays lie densely.
        self.ask(|this| unsafe {
            let room = found.len() * 3;
            sys::locus_weights_gradients(this, rows.start, count, id, found.as_mut_ptr() as *mut f32, room)
        })?;
        Ok(found)
    }

    /// Bring the weights up to date with their diagram after it was solved or updated again: the rows that changed, in
    /// rising order.
    pub fn update(&mut self) -> Result<Vec<u64>> {
        let rows = self.size()?.0;
        let mut changed = vec![0; rows as usize];
        let mut count = 0;
        let _graph = self.kept.graph.shared()?;
        let _diagram = self.diagram.gate.alone("diagram")?;
        let _held = self.kept.gate.alone("weights")?;
        // SAFETY: there is room for every row's number.
        let status = unsafe { sys::locus_weights_update(self.handle.as_ptr(), changed.as_mut_ptr(), changed.len(), &mut count) };
        self.kept.graph.check(status)?;
        changed.truncate(count);
        // SAFETY: without room only their number is told.
        unsafe { sys::locus_diagram_get_seeds(self.diagram.raw.as_ptr(), std::ptr::null_mut(), 0, &mut self.seeds) };
        Ok(changed)
    }
}

fn out_of_range(what: &str, rows: &std::ops::Range<u64>) -> Error {
    Error::Argument(format!("Weights::{what}: there are no rows {}..{}", rows.start, rows.end))
}

fn room(rows: usize, columns: usize) -> Result<usize> {
    rows.checked_mul(columns).ok_or_else(|| Error::Argument(format!("Weights: {rows} rows of {columns} numbers")))
}

impl Drop for Weights {
    fn drop(&mut self) {
        // SAFETY: the handle is this object's alone; the closure goes after it.
        unsafe { sys::locus_weights_destroy(self.handle.as_ptr()) }
    }
}
