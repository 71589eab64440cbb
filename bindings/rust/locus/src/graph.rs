use crate::callback::{caught, log_at, Gate, HasGate, Held, Log, Logger};
use crate::error::check;
use crate::{sys, Error, Result};
use std::any::Any;
use std::os::raw::c_void;
use std::ptr::{null, NonNull};
use std::sync::{Arc, Mutex, Weak};

/// What a graph was made of.
pub use sys::locus_graph_info as GraphInfo;
/// A box of voxels: origin (x, y, z) and extent.
pub use sys::locus_voxel_box as VoxelBox;

constants! {
    /// The weight of an edge from its length and the compliances of its ends.
    WeightRule {
        /// length * mean of the compliances
        MeanCompliance = LOCUS_WEIGHT_MEAN_COMPLIANCE,
        /// length * the larger compliance
        MaxCompliance = LOCUS_WEIGHT_MAX_COMPLIANCE,
        /// length / mean stiffness to the power of `stiffness_exponent`
        MeanStiffness = LOCUS_WEIGHT_MEAN_STIFFNESS,
        /// length
        Uniform = LOCUS_WEIGHT_UNIFORM,
    }
    /// What the numbers of the volume are.
    Material {
        /// distance per length
        Compliance = LOCUS_MATERIAL_COMPLIANCE,
        /// its inverse
        Stiffness = LOCUS_MATERIAL_STIFFNESS,
    }
    /// Bits of a voxel's packed distance and label.
    Word {
        /// 32 where that suffices, else 64
        Auto = LOCUS_WORD_AUTO,
        /// 32
        Bits32 = LOCUS_WORD_32,
        /// 64
        Bits64 = LOCUS_WORD_64,
    }
    /// Where diagrams are computed.
    Backend {
        /// CUDA where it is there and pays, else the CPU
        Auto = LOCUS_BACKEND_AUTO,
        /// the CPU
        Cpu = LOCUS_BACKEND_CPU,
        /// an NVIDIA GPU
        Cuda = LOCUS_BACKEND_CUDA,
    }
    /// The instruction set of the SIMD code.
    Simd {
        /// the best that is there
        Auto = LOCUS_SIMD_AUTO,
        /// none
        Scalar = LOCUS_SIMD_SCALAR,
        /// SSE 4
        Sse4 = LOCUS_SIMD_SSE4,
        /// AVX2
        Avx2 = LOCUS_SIMD_AVX2,
        /// AVX-512
        Avx512 = LOCUS_SIMD_AVX512,
        /// NEON
        Neon = LOCUS_SIMD_NEON,
    }
}

type WeightFn = Box<dyn Fn(u64, u64, f64) -> f64 + Send + Sync>;

/// How to make a graph; the fields and defaults are those of `locus_graph_options` in `locus/graph.h`.
pub struct GraphOptions {
    plain: sys::locus_graph_options,
    weight: Option<WeightFn>,
    log: Option<Log>,
}

impl GraphOptions {
    /// The defaults for a grid of nx * ny * nz voxels.
    pub fn new(dims: [u64; 3]) -> Self {
        let mut plain = defaults!(locus_graph_options, locus_graph_options_init);
        plain.dims = dims;
        Self { plain, weight: None, log: None }
    }

    setters! {
        /// A voxel's edge lengths; default 1.
        spacing: [f64; 3];
        /// 6, 18 or 26; default 26.
        connectivity: u32;
        /// Default [`WeightRule::MeanCompliance`].
        weight_rule: WeightRule => u32::from;
        /// Default [`Material::Compliance`].
        material: Material => u32::from;
        /// Default [`Word::Auto`].
        word_bits: Word => u32::from;
        /// In (0, 8]; default 1.
        stiffness_exponent: f64;
        /// Seeds a diagram must be able to hold.
        max_seeds: u64;
        /// Steps per unit of distance; default: chosen from the data.
        scale: f64;
        /// Largest relative rounding error of a weight when the scale is chosen.
        precision: f64;
        /// The smallest passable value that may come later.
        material_min: f64;
        /// The largest passable value that may come later.
        material_max: f64;
        /// Most threads a call may use; default: one per core.
        threads: u32;
        /// Default [`Backend::Auto`].
        backend: Backend => u32::from;
        /// Default [`Simd::Auto`].
        simd: Simd => u32::from;
    }

    /// Weigh edges by a function of the voxels' indices u < v and the edge's length, always the same for the same pair;
    /// negative, NaN or infinite: no such edge. Several threads may call it at once. A panic in it goes on out of the call
    /// that needed it, which has no result then: a diagram is unsolved.
    #[must_use]
    pub fn weight(mut self, weight: impl Fn(u64, u64, f64) -> f64 + Send + Sync + 'static) -> Self {
        self.plain.weight_rule = sys::LOCUS_WEIGHT_CALLER;
        self.weight = Some(Box::new(weight));
        self
    }

    /// Be told lines of text.
    #[must_use]
    pub fn log(mut self, log: impl Fn(i32, &str) + Send + Sync + 'static) -> Self {
        self.log = Some(Box::new(log));
        self
    }
}

/// What a graph shares with its diagrams and weights, which may outlive it.
pub(crate) struct Shared {
    gate: Gate,
    weight: Option<WeightFn>,
    panic: Mutex<Option<Box<dyn Any + Send>>>,
    logger: Option<Logger>,
}

impl HasGate for Shared {
    fn gate(&self) -> &Gate {
        &self.gate
    }
}

impl Shared {
    pub(crate) fn shared(&self) -> Result<Held<'_>> {
        self.gate.shared("graph")
    }

    pub(crate) fn alone(&self) -> Result<Held<'_>> {
        self.gate.alone("graph")
    }

    pub(crate) fn panicked(&self) -> bool {
        crate::callback::panicked() || self.weight.is_some() && self.panic.lock().map_or(true, |kept| kept.is_some())
    }

    /// What a call came to; a panic of the weight function, which other threads may have called, goes on here.
    pub(crate) fn check(&self, status: sys::locus_status) -> Result<()> {
        if self.weight.is_some() {
            let payload = self.panic.lock().ok().and_then(|mut kept| kept.take());
            if let Some(payload) = payload {
                std::panic::resume_unwind(payload);
            }
        }
        check(status)
    }
}

unsafe extern "C" fn weight_at(u: u64, v: u64, length: f64, user: *mut c_void) -> f64 {
    let shared = &*(user as *const Shared);
    match &shared.weight {
        Some(weight) => caught(&shared.gate, || weight(u, v, length)).unwrap_or_else(|payload| {
            if let Ok(mut kept) = shared.panic.lock() {
                kept.get_or_insert(payload);
            }
            // More than a word can hold: the call fails, and nothing is computed from it.
            f64::MAX
        }),
        None => f64::NAN,
    }
}

/// A voxel graph: a grid of voxels, each with a compliance or impassable.
///
/// Diagrams made from it see its changes when they are solved or updated again, and stay usable when it is dropped. A
/// change beside a call on one of its diagrams is [`Error::Busy`], and so are calls from within its callbacks.
///
/// ```
/// use locus::{Diagram, Graph, GraphOptions, Seed};
/// # fn main() -> locus::Result<()> {
/// let graph = Graph::new(GraphOptions::new([5, 1, 1]), Some(&[1.0, 1.0, 10.0, 1.0, 1.0]))?;
/// let mut diagram = Diagram::new(&graph)?;
/// diagram.add_seeds(&[Seed { id: 7, ..Seed::default() }, Seed { x: 4, id: 8, ..Seed::default() }])?;
/// diagram.solve()?;
/// assert_eq!(diagram.distances(None)?, [0.0, 1.0, 6.5, 1.0, 0.0]);
/// assert_eq!(diagram.labels(None)?, [7, 7, 7, 8, 8]);
/// # Ok(()) }
/// ```
pub struct Graph {
    handle: NonNull<sys::locus_graph>,
    shared: Arc<Shared>,
    dims: [u64; 3],
}

// SAFETY: a handle may be used by any thread; calls that exclude each other meet at the gate; closures are Send and Sync.
unsafe impl Send for Graph {}
unsafe impl Sync for Graph {}

impl Graph {
    /// Make a graph of dims\[0\] * dims\[1\] * dims\[2\] values, x fastest; without them every voxel is impassable.
    pub fn new(options: GraphOptions, material: Option<&[f32]>) -> Result<Self> {
        let GraphOptions { mut plain, weight, log } = options;
        let dims = plain.dims;
        if let Some(values) = material {
            if product(dims) != Some(values.len() as u64) {
                let text = format!(
                    "Graph::new: material has {} values for {} x {} x {} voxels",
                    values.len(),
                    dims[0],
                    dims[1],
                    dims[2]
                );
                return Err(Error::Argument(text));
            }
        }
        let shared = Arc::new_cyclic(|owner: &Weak<Shared>| {
            let logger = log.map(|log| Logger { log, owner: owner.clone() });
            Shared { gate: Gate::default(), weight, panic: Mutex::new(None), logger }
        });
        if shared.weight.is_some() {
            plain.weight = Some(weight_at);
            plain.weight_user = Arc::as_ptr(&shared) as *mut c_void;
        }
        if let Some(logger) = &shared.logger {
            plain.log = Some(log_at);
            plain.log_user = logger as *const Logger as *mut c_void;
        }
        let mut made = std::ptr::null_mut();
        // SAFETY: the values are as many as the grid's voxels; `shared` outlives all that calls its closures.
        let status = unsafe { sys::locus_graph_create(&plain, material.map_or(null(), <[f32]>::as_ptr), &mut made) };
        let graph = NonNull::new(made).map(|handle| Self { handle, shared: shared.clone(), dims });
        shared.check(status)?;
        graph.ok_or_else(|| Error::Internal("locus_graph_create made nothing".into()))
    }

    pub(crate) fn raw(&self) -> *mut sys::locus_graph {
        self.handle.as_ptr()
    }

    pub(crate) fn shared(&self) -> &Arc<Shared> {
        &self.shared
    }

    /// Voxels in x, y, z.
    pub fn dims(&self) -> [u64; 3] {
        self.dims
    }

    /// What the graph was made of.
    pub fn info(&self) -> Result<GraphInfo> {
        let _held = self.shared.shared()?;
        let mut info = sized!(locus_graph_info);
        // SAFETY: the handle is alive.
        self.shared.check(unsafe { sys::locus_graph_get_info(self.raw(), &mut info) })?;
        Ok(info)
    }

    /// Replace the materials of a box, x fastest.
    pub fn set_box(&mut self, within: VoxelBox, values: &[f32]) -> Result<()> {
        let _held = self.shared.alone()?;
        if product(within.extent) != Some(values.len() as u64) {
            let [x, y, z] = within.extent;
            return Err(Error::Argument(format!("Graph::set_box: {} values for {x} x {y} x {z} voxels", values.len())));
        }
        // SAFETY: the values are as many as the box's voxels.
        self.shared.check(unsafe { sys::locus_graph_set_box(self.raw(), &within, values.as_ptr()) })
    }

    /// The same with one value; NaN removes the material.
    pub fn fill_box(&mut self, within: VoxelBox, value: f32) -> Result<()> {
        let _held = self.shared.alone()?;
        // SAFETY: the handle is alive and nobody else is inside.
        self.shared.check(unsafe { sys::locus_graph_fill_box(self.raw(), &within, value) })
    }

    /// Replace the materials of voxels given by their indices x + nx * (y + ny * z).
    pub fn set_voxels(&mut self, voxels: &[u64], values: &[f32]) -> Result<()> {
        let _held = self.shared.alone()?;
        if voxels.len() != values.len() {
            return Err(Error::Argument(format!("Graph::set_voxels: {} values for {} voxels", values.len(), voxels.len())));
        }
        // SAFETY: both lists are as long as said.
        let status = unsafe { sys::locus_graph_set_voxels(self.raw(), voxels.as_ptr(), values.as_ptr(), voxels.len()) };
        self.shared.check(status)
    }

    /// The materials of a box (`None`: all), NaN where impassable.
    pub fn materials(&self, within: impl Into<Option<VoxelBox>>) -> Result<Vec<f32>> {
        let _held = self.shared.shared()?;
        let within = within.into();
        let mut values = vec![0.0; room(within, self.dims)];
        // SAFETY: there is room for as many values as said.
        let status = unsafe { sys::locus_graph_get_box(self.raw(), box_at(&within), values.as_mut_ptr(), values.len()) };
        self.shared.check(status)?;
        Ok(values)
    }

    /// The integer weight of an edge between two voxel indices; 0: there is none.
    pub fn edge_weight(&self, u: u64, v: u64) -> Result<u64> {
        let _held = self.shared.shared()?;
        let mut steps = 0;
        // SAFETY: the handle is alive.
        self.shared.check(unsafe { sys::locus_graph_edge_weight(self.raw(), u, v, &mut steps) })?;
        Ok(steps)
    }

    /// Cut the edges that a plane separates; how many were whole before.
    pub fn cut_plane(&mut self, point: [f64; 3], normal: [f64; 3], within: impl Into<Option<VoxelBox>>) -> Result<u64> {
        let _held = self.shared.alone()?;
        let (within, mut edges) = (within.into(), 0);
        // SAFETY: three numbers each.
        let status =
            unsafe { sys::locus_graph_cut_plane(self.raw(), point.as_ptr(), normal.as_ptr(), box_at(&within), &mut edges) };
        self.shared.check(status)?;
        Ok(edges)
    }

    /// Cut along a mesh: triangles of three indices into the vertices.
    pub fn cut_mesh(&mut self, vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<u64> {
        let _held = self.shared.alone()?;
        let mut edges = 0;
        // SAFETY: both lists are as long as said; arrays of arrays lie densely.
        let status = unsafe {
            let (points, corners) = (vertices.as_ptr() as *const f64, triangles.as_ptr() as *const u32);
            sys::locus_graph_cut_mesh(self.raw(), points, vertices.len(), corners, triangles.len(), &mut edges)
        };
        self.shared.check(status)?;
        Ok(edges)
    }

    /// Undo the cuts of the edges with an end in a box (`None`: all); how many they were.
    pub fn mend_box(&mut self, within: impl Into<Option<VoxelBox>>) -> Result<u64> {
        let _held = self.shared.alone()?;
        let (within, mut edges) = (within.into(), 0);
        // SAFETY: the handle is alive and nobody else is inside.
        self.shared.check(unsafe { sys::locus_graph_mend_box(self.raw(), box_at(&within), &mut edges) })?;
        Ok(edges)
    }
}

impl Drop for Graph {
    fn drop(&mut self) {
        // SAFETY: the handle is this object's alone, and what diagrams need stays.
        unsafe { sys::locus_graph_destroy(self.raw()) }
    }
}

fn product(extent: [u64; 3]) -> Option<u64> {
    extent[0].checked_mul(extent[1])?.checked_mul(extent[2])
}

pub(crate) fn box_at(within: &Option<VoxelBox>) -> *const VoxelBox {
    within.as_ref().map_or(null(), |found| found as *const VoxelBox)
}

/// The voxels of a box; 0 for one outside the grid, which the library refuses.
pub(crate) fn room(within: Option<VoxelBox>, dims: [u64; 3]) -> usize {
    let found = within.unwrap_or(VoxelBox { origin: [0; 3], extent: dims });
    let inside = (0..3).all(|axis| found.origin[axis].checked_add(found.extent[axis]).map_or(false, |end| end <= dims[axis]));
    if inside {
        product(found.extent).unwrap_or(0) as usize
    } else {
        0
    }
}
