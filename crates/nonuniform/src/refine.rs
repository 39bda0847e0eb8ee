//! Meshes refined by a scheme, in any number of levels.

use crate::hybrid::{HybridNet, Outside};
use crate::{
    EigenPolyhedron, Error, FirstLevel, NGon, Net, Place, Spokes, eigen_polyhedron_step, first_level, nurss, nurss_step,
};
use eigenring_scheme::Table;
use eigenring_surface::{Mesh, Point3};

/// A scheme with knot intervals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// Sederberg, Zheng, Sewell and Sabin 1998.
    Nurss,
    /// Li, Finnigan and Sederberg 2016.
    EigenPolyhedron,
    /// Li, Wei and Zhang 2019, with the rule of its first level.
    Hnuss(FirstLevel),
}

/// The schemes by name, and what they are.
pub const NAMES: [(&str, &str); 3] = [
    (
        "nurss",
        "knot intervals, by averages around extraordinary vertices (Sederberg, Zheng, Sewell and Sabin 1998)",
    ),
    (
        "eigen-polyhedron",
        "knot intervals, with Catmull-Clark's subdominant eigenvalue (Li, Finnigan and Sederberg 2016)",
    ),
    (
        "hnuss[:simple|printed|improved]",
        "knot intervals, on a hybrid net with extraordinary faces (Li, Wei and Zhang 2019)",
    ),
];

impl Scheme {
    /// Refuses intervals around a vertex for which the scheme does not exist, in the words of spokes.
    pub(crate) fn check(self, spokes: &Spokes) -> Result<(), Error> {
        match self {
            Scheme::Nurss => nurss::matrix::<f64>(spokes).map(drop),
            Scheme::EigenPolyhedron => {
                nurss::matrix::<f64>(spokes)?;
                EigenPolyhedron::new(spokes.intervals()).map(drop)
            }
            Scheme::Hnuss(rule) => {
                NGon::new(spokes.intervals())?;
                first_level::rows(spokes, rule).map(drop)
            }
        }
    }
}

impl std::fmt::Display for Scheme {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Scheme::Nurss => "nurss",
            Scheme::EigenPolyhedron => "eigen-polyhedron",
            Scheme::Hnuss(FirstLevel::Improved) => "hnuss",
            Scheme::Hnuss(FirstLevel::Simple) => "hnuss:simple",
            Scheme::Hnuss(FirstLevel::Printed) => "hnuss:printed",
        })
    }
}

impl std::str::FromStr for Scheme {
    type Err = eigenring_scheme::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(match text {
            "nurss" => Scheme::Nurss,
            "eigen-polyhedron" => Scheme::EigenPolyhedron,
            "hnuss" | "hnuss:improved" => Scheme::Hnuss(FirstLevel::Improved),
            "hnuss:simple" => Scheme::Hnuss(FirstLevel::Simple),
            "hnuss:printed" => Scheme::Hnuss(FirstLevel::Printed),
            _ => {
                return Err(eigenring_scheme::Error::Spec {
                    spec: text.to_owned(),
                    reason: "no such scheme with knot intervals".to_owned(),
                    accepted: NAMES.map(|(name, _)| name).join(" | "),
                });
            }
        })
    }
}

/// What refinement has made.
#[derive(Clone, Debug)]
pub struct Refined {
    /// The mesh, with its intervals.
    pub mesh: Mesh,
    /// Vertices, and faces as vertices, with the simple rule for want of an eigen-polyhedron.
    pub simple: Vec<Place>,
}

/// A control mesh and nets that follow from it, each with the sparse map that makes its points of those
/// before.
#[derive(Clone, Debug)]
pub struct Refinement {
    scheme: Scheme,
    tables: Vec<Table<f64>>,
    current: Current,
    /// As in [`Refined`].
    pub simple: Vec<Place>,
    /// Of the mesh that was given, and those since.
    levels: usize,
    split: bool,
}

#[derive(Clone, Debug)]
enum Current {
    Primal(Net),
    Hybrid(HybridNet),
}

impl Refinement {
    /// Begins with a mesh. HNUSS makes its hybrid net, after one level of NURSS where faces are no quads; a
    /// hybrid net stays what it is.
    ///
    /// # Errors
    /// Those of [`Net::new`] and [`HybridNet::of`].
    pub fn new(mesh: &Mesh, scheme: Scheme, outside: Outside) -> Result<Self, Error> {
        let mut net = Net::new(mesh)?;
        let mut refinement = Refinement {
            scheme,
            tables: Vec::new(),
            current: Current::Primal(net.clone()),
            simple: Vec::new(),
            levels: mesh.features.levels as usize,
            split: false,
        };
        if let Scheme::Hnuss(rule) = scheme {
            if let Some(hybrid) = HybridNet::again(&net) {
                refinement.current = Current::Hybrid(hybrid);
                return Ok(refinement);
            }
            refinement.split = !net.mesh().is_quads();
            if refinement.split {
                let step = nurss_step(&net)?;
                refinement.tables.push(step.table);
                net = step.net;
            }
            let converted = HybridNet::of(&net, rule, outside)?;
            refinement.tables.push(converted.table);
            refinement.simple = converted.simple;
            refinement.current = Current::Hybrid(converted.net);
        }
        Ok(refinement)
    }

    /// The same net as one of a later level, of which nothing is known before it.
    pub(crate) fn at_a_later_level(mut self) -> Self {
        self.tables.clear();
        self.levels = self.levels.max(1);
        self
    }

    /// One level more.
    ///
    /// # Errors
    /// Those of the scheme's step.
    pub fn refine(&mut self) -> Result<(), Error> {
        let (table, next) = match &self.current {
            Current::Hybrid(net) => {
                let (table, net) = net.halved()?;
                (table, Current::Hybrid(net))
            }
            Current::Primal(net) => {
                let step = match self.scheme {
                    Scheme::EigenPolyhedron if self.levels > 0 => eigen_polyhedron_step(net)?,
                    _ => nurss_step(net)?,
                };
                (step.table, Current::Primal(step.net))
            }
        };
        self.tables.push(table);
        self.current = next;
        self.levels += 1;
        Ok(())
    }

    /// The scheme.
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// How many levels were made, with those that had made the mesh before.
    pub fn levels(&self) -> usize {
        self.levels
    }

    /// Whether a level of NURSS came before the hybrid net, since faces were no quads.
    pub fn is_split(&self) -> bool {
        self.split
    }

    /// The last net.
    pub fn net(&self) -> &Net {
        match &self.current {
            Current::Primal(net) => net,
            Current::Hybrid(net) => net.net(),
        }
    }

    /// The last net, if the scheme is HNUSS.
    pub fn hybrid(&self) -> Option<&HybridNet> {
        match &self.current {
            Current::Primal(_) => None,
            Current::Hybrid(net) => Some(net),
        }
    }

    /// The maps from the control mesh to the last net, in their order.
    pub fn tables(&self) -> &[Table<f64>] {
        &self.tables
    }

    /// The mesh of the last net, of HNUSS after so many halvings, which need no tables: of the points that
    /// `parts` makes of those found, and their weights.
    fn finest<const D: usize>(
        &self,
        points: &[[f64; D]],
        halvings: usize,
        parts: impl Fn(&[[f64; D]]) -> (Vec<Point3<f64>>, Option<Vec<f64>>),
    ) -> Result<Mesh, Error> {
        let points = self.apply(points)?;
        let Some(hybrid) = self.hybrid() else {
            let (points, weights) = parts(&points);
            return Ok(self.net().with_points(points, weights));
        };
        let mut blocks = hybrid.blocks(points);
        (0..halvings).try_for_each(|_| blocks.halve())?;
        let (points, weights) = parts(blocks.points());
        let mut mesh = blocks.mesh(points)?;
        if let Some(weights) = weights {
            mesh.set_weights(weights);
        }
        mesh.features.knots = blocks.intervals().into_iter().collect();
        Ok(mesh)
    }

    /// Points of the last net from those of the control mesh without unused ones: `D` numbers each, whatever
    /// they mean.
    ///
    /// # Errors
    /// [`eigenring_scheme::Error::TablePoint`] for fewer points.
    pub fn apply<const D: usize>(&self, points: &[[f64; D]]) -> Result<Vec<[f64; D]>, Error> {
        let mut points = points.to_vec();
        for table in &self.tables {
            points = table.apply(&points)?;
        }
        Ok(points)
    }
}

/// The mesh after so many levels; of HNUSS, level 0 is the hybrid net. With weights, homogeneous coordinates
/// are refined: `(w x, w y, w z, w)`.
///
/// # Errors
/// Those of [`Refinement`].
pub fn refined(mesh: &Mesh, scheme: Scheme, levels: usize, outside: Outside) -> Result<Refined, Error> {
    let mut refinement = Refinement::new(mesh, scheme, outside)?;
    if refinement.hybrid().is_none() {
        (0..levels).try_for_each(|_| refinement.refine())?;
    }
    let mesh = mesh.without_unused();
    let mut refined = match mesh.weights() {
        None => {
            let points: Vec<[f64; 3]> = mesh.points().iter().map(|p| [p.x, p.y, p.z]).collect();
            refinement.finest(&points, levels, |points| {
                (points.iter().map(|&point| Point3::from(point)).collect(), None)
            })?
        }
        Some(weights) => {
            let points = mesh.points().iter().zip(weights);
            let lifted: Vec<[f64; 4]> = points.map(|(p, w)| [w * p.x, w * p.y, w * p.z, *w]).collect();
            refinement.finest(&lifted, levels, |points| {
                let projected = points.iter().map(|[x, y, z, w]| Point3::new(x / w, y / w, z / w));
                (projected.collect(), Some(points.iter().map(|p| p[3]).collect()))
            })?
        }
    };
    // the net of HNUSS says by its faces what it is
    if refinement.hybrid().is_none() {
        refined.features.levels = refinement.levels as u32;
    }
    Ok(Refined {
        mesh: refined,
        simple: refinement.simple,
    })
}
