use crate::callback::{progress_at, Gate, Progress};
use crate::error::listed;
use crate::graph::{box_at, room, Shared};
use crate::{sys, Error, Graph, Result, VoxelBox};
use std::ptr::NonNull;
use std::sync::Arc;

/// Two cells that touch.
pub use sys::locus_cell_pair as CellPair;
/// What the latest solve did.
pub use sys::locus_diagram_stats as DiagramStats;
/// A seed: a voxel with an id of yours.
pub use sys::locus_seed as Seed;

/// The label of a voxel that no seed reaches.
pub const NO_SEED: u32 = sys::LOCUS_NO_SEED;

constants! {
    /// How a diagram is solved; the results are the same.
    Engine {
        /// the bricks
        Auto = LOCUS_ENGINE_AUTO,
        /// Dijkstra with a binary heap
        Heap = LOCUS_ENGINE_HEAP,
        /// Dijkstra with buckets
        Bucket = LOCUS_ENGINE_BUCKET,
        /// relax all active voxels
        Relax = LOCUS_ENGINE_RELAX,
        /// blocks of voxels in SIMD registers
        Bricks = LOCUS_ENGINE_BRICKS,
        /// CUDA only
        Compact = LOCUS_ENGINE_COMPACT,
    }
    /// The distances by which seeds are placed.
    Metric {
        /// those of the graph
        Compliance = LOCUS_PLACE_COMPLIANCE,
        /// those of the same grid with uniform weights
        Uniform = LOCUS_PLACE_UNIFORM,
    }
}

/// How to make a diagram: `locus_diagram_options` in `locus/diagram.h`.
#[derive(Clone)]
pub struct DiagramOptions {
    plain: sys::locus_diagram_options,
}

impl Default for DiagramOptions {
    fn default() -> Self {
        Self { plain: defaults!(locus_diagram_options, locus_diagram_options_init) }
    }
}

impl DiagramOptions {
    setters! {
        /// Default [`Engine::Auto`].
        engine: Engine => u32::from;
        /// Keep the active voxels per iteration; default no.
        record_trace: bool => u32::from;
        /// Voxels farther than this stay unreached.
        max_distance: f64;
        /// A grain's voxels, for [`Engine::Compact`].
        grain: [u32; 3];
        /// The CUDA backend leaves results in the GPU's memory until something reads them; default no.
        on_device: bool => u32::from;
    }
}

/// How to place seeds: `locus_place_options` in `locus/diagram.h`.
#[derive(Clone)]
pub struct PlaceOptions {
    plain: sys::locus_place_options,
}

impl PlaceOptions {
    /// Add `count` free seeds.
    pub fn new(count: u64) -> Self {
        let mut plain = defaults!(locus_place_options, locus_place_options_init);
        plain.count = count;
        Self { plain }
    }

    setters! {
        /// Ids of the added seeds begin here; default 0.
        first_id: u32;
        /// Most rounds of Lloyd; default 100.
        lloyd_iterations: u32;
        /// Default [`Metric::Compliance`].
        metric: Metric => u32::from;
    }
}

/// What an update changed: the smallest box around it, and how many voxels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Change {
    /// extents 0 where nothing changed
    pub within: VoxelBox,
    /// voxels whose label or distance changed
    pub voxels: u64,
}

/// The C handle, which the weights of the diagram hold, too.
pub(crate) struct Handle {
    pub(crate) raw: NonNull<sys::locus_diagram>,
    pub(crate) gate: Gate,
}

// SAFETY: as for Graph; weights of the diagram meet its own calls at its gate.
unsafe impl Send for Handle {}
unsafe impl Sync for Handle {}

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: nobody else holds it.
        unsafe { sys::locus_diagram_destroy(self.raw.as_ptr()) }
    }
}

/// The Voronoi diagram of a graph: every voxel's nearest seed and its distance. See [`Graph`] for an example.
pub struct Diagram {
    handle: Arc<Handle>,
    graph: Arc<Shared>,
    dims: [u64; 3],
}

impl Diagram {
    /// A diagram without seeds, unsolved.
    pub fn new(graph: &Graph) -> Result<Self> {
        Self::with(graph, &DiagramOptions::default())
    }

    /// The same with options.
    pub fn with(graph: &Graph, options: &DiagramOptions) -> Result<Self> {
        let shared = graph.shared().clone();
        let held = shared.alone()?;
        let mut made = std::ptr::null_mut();
        // SAFETY: the graph is alive and nobody else is inside.
        shared.check(unsafe { sys::locus_diagram_create(graph.raw(), &options.plain, &mut made) })?;
        let raw = NonNull::new(made).ok_or_else(|| Error::Internal("locus_diagram_create made nothing".into()))?;
        drop(held);
        let handle = Arc::new(Handle { raw, gate: Gate::default() });
        Ok(Self { handle, graph: shared, dims: graph.dims() })
    }

    pub(crate) fn raw(&self) -> *mut sys::locus_diagram {
        self.handle.raw.as_ptr()
    }

    pub(crate) fn graph(&self) -> &Arc<Shared> {
        &self.graph
    }

    pub(crate) fn handle(&self) -> &Arc<Handle> {
        &self.handle
    }

    /// A call that changes the diagram.
    fn change(&mut self, call: impl FnOnce(*mut sys::locus_diagram) -> i32) -> Result<()> {
        let _graph = self.graph.shared()?;
        let _held = self.handle.gate.alone("diagram")?;
        self.graph.check(call(self.raw()))
    }

    /// A call that reads it.
    fn ask(&self, call: impl FnOnce(*const sys::locus_diagram) -> i32) -> Result<()> {
        let _graph = self.graph.shared()?;
        let _held = self.handle.gate.shared("diagram")?;
        self.graph.check(call(self.raw()))
    }

    /// A call that reads a list.
    fn list<T: Clone + Default>(
        &self,
        mut fill: impl FnMut(*const sys::locus_diagram, *mut T, usize, *mut usize) -> i32,
    ) -> Result<Vec<T>> {
        let _graph = self.graph.shared()?;
        let _held = self.handle.gate.shared("diagram")?;
        let found = listed(|into, capacity, count| fill(self.raw(), into, capacity, count));
        self.graph.check(sys::LOCUS_OK)?;
        found
    }

    /// Add seeds: all of them, or none on an error.
    pub fn add_seeds(&mut self, seeds: &[Seed]) -> Result<()> {
        // SAFETY: the list is as long as said.
        self.change(|this| unsafe { sys::locus_diagram_add_seeds(this, seeds.as_ptr(), seeds.len()) })
    }

    /// Remove the seeds with these ids.
    pub fn remove_seeds(&mut self, ids: &[u32]) -> Result<()> {
        // SAFETY: the list is as long as said.
        self.change(|this| unsafe { sys::locus_diagram_remove_seeds(this, ids.as_ptr(), ids.len()) })
    }

    /// Move a seed to the voxel (x, y, z).
    pub fn move_seed(&mut self, id: u32, [x, y, z]: [u64; 3]) -> Result<()> {
        // SAFETY: the handle is alive.
        self.change(|this| unsafe { sys::locus_diagram_move_seed(this, id, x, y, z) })
    }

    /// The seeds, in the order they were added.
    pub fn seeds(&self) -> Result<Vec<Seed>> {
        // SAFETY: there is room for as many as said.
        self.list(|this, into, capacity, count| unsafe { sys::locus_diagram_get_seeds(this, into, capacity, count) })
    }

    /// Add free seeds by farthest-point sampling and move all free ones to the centres of their cells. The closure is
    /// told the fraction done; false cancels.
    pub fn place_seeds(&mut self, options: &PlaceOptions, mut progress: impl FnMut(f64) -> bool) -> Result<()> {
        let (graph, handle) = (self.graph.clone(), self.handle.clone());
        let mut told = Progress { owner: &handle.gate, stop: &|| graph.panicked(), told: &mut progress };
        let mut plain = options.plain;
        plain.progress = Some(progress_at);
        plain.progress_user = told.user();
        // SAFETY: the closure outlives the call.
        self.change(|this| unsafe { sys::locus_diagram_place_seeds(this, &plain) })
    }

    /// Compute the diagram anew.
    pub fn solve(&mut self) -> Result<()> {
        self.solve_with(|_| true)
    }

    /// The same, telling the fraction done; false cancels, which is [`Error::Stopped`].
    pub fn solve_with(&mut self, mut progress: impl FnMut(f64) -> bool) -> Result<()> {
        let (graph, handle) = (self.graph.clone(), self.handle.clone());
        let mut told = Progress { owner: &handle.gate, stop: &|| graph.panicked(), told: &mut progress };
        // SAFETY: the closure outlives the call.
        self.change(|this| unsafe { sys::locus_diagram_solve(this, Some(progress_at), told.user()) })
    }

    /// Bring the diagram up to date with all that was changed since its latest solve or update.
    pub fn update(&mut self) -> Result<Change> {
        self.update_with(|_| true)
    }

    /// The same, telling the fraction done; false cancels.
    pub fn update_with(&mut self, mut progress: impl FnMut(f64) -> bool) -> Result<Change> {
        let (graph, handle) = (self.graph.clone(), self.handle.clone());
        let mut told = Progress { owner: &handle.gate, stop: &|| graph.panicked(), told: &mut progress };
        let mut change = Change::default();
        // SAFETY: the closure outlives the call.
        self.change(|this| unsafe {
            sys::locus_diagram_update(this, &mut change.within, &mut change.voxels, Some(progress_at), told.user())
        })?;
        Ok(change)
    }

    /// The nearest seed's id of every voxel of a box (`None`: all), x fastest.
    pub fn labels(&self, within: impl Into<Option<VoxelBox>>) -> Result<Vec<u32>> {
        let within = within.into();
        let mut found = vec![0; room(within, self.dims)];
        // SAFETY: there is room for as many as said.
        self.ask(|this| unsafe { sys::locus_diagram_labels(this, box_at(&within), found.as_mut_ptr(), found.len()) })?;
        Ok(found)
    }

    /// The distances, infinite where no seed reaches.
    pub fn distances(&self, within: impl Into<Option<VoxelBox>>) -> Result<Vec<f32>> {
        let within = within.into();
        let mut found = vec![0.0; room(within, self.dims)];
        // SAFETY: there is room for as many as said.
        self.ask(|this| unsafe { sys::locus_diagram_distances(this, box_at(&within), found.as_mut_ptr(), found.len()) })?;
        Ok(found)
    }

    /// The exact distances in steps: divide by the scale of [`Graph::info`].
    pub fn distances_exact(&self, within: impl Into<Option<VoxelBox>>) -> Result<Vec<u64>> {
        let within = within.into();
        let mut found = vec![0; room(within, self.dims)];
        // SAFETY: there is room for as many as said.
        self.ask(|this| unsafe { sys::locus_diagram_distances_exact(this, box_at(&within), found.as_mut_ptr(), found.len()) })?;
        Ok(found)
    }

    /// The voxel indices of the shortest path from (x, y, z) to its seed; empty where no seed reaches.
    pub fn path(&self, [x, y, z]: [u64; 3]) -> Result<Vec<u64>> {
        // SAFETY: there is room for as many as said.
        self.list(|this, into, capacity, count| unsafe { sys::locus_diagram_path(this, x, y, z, into, capacity, count) })
    }

    /// The voxels of each seed's cell, in the order of the seeds.
    pub fn cell_sizes(&self) -> Result<Vec<u64>> {
        // SAFETY: there is room for as many as said.
        self.list(|this, into, capacity, count| unsafe { sys::locus_diagram_cell_sizes(this, into, capacity, count) })
    }

    /// The pairs of cells that touch.
    pub fn cell_pairs(&self) -> Result<Vec<CellPair>> {
        // SAFETY: there is room for as many as said.
        self.list(|this, into, capacity, count| unsafe { sys::locus_diagram_cell_pairs(this, into, capacity, count) })
    }

    /// The active voxels of each iteration, of a diagram made with `record_trace`.
    pub fn trace(&self) -> Result<Vec<u64>> {
        // SAFETY: there is room for as many as said.
        self.list(|this, into, capacity, count| unsafe { sys::locus_diagram_trace(this, into, capacity, count) })
    }

    /// What the latest solve did.
    pub fn stats(&self) -> Result<DiagramStats> {
        let mut stats = sized!(locus_diagram_stats);
        // SAFETY: the handle is alive.
        self.ask(|this| unsafe { sys::locus_diagram_get_stats(this, &mut stats) })?;
        Ok(stats)
    }
}
