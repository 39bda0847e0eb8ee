//! Refinement of whole meshes, level by level.

use crate::active::Ends;
use crate::dual::CellNet;
use crate::refine::step;
use crate::rules::{Method, Rules};
use crate::workers::{Serial, Workers};
use crate::{Boundary, Error, Mesh, Topology, isolation};
use eigenring_scheme::{Definition, Spec};

/// Refines meshes by a scheme.
pub struct Refiner<'a> {
    rules: &'a Rules,
    /// What happens at the boundary, whatever the mesh says.
    pub boundary: Option<Boundary>,
    /// Who does the work of fine levels.
    pub workers: &'a dyn Workers,
}

impl<'a> Refiner<'a> {
    /// Refinement by the given rules.
    pub fn new(rules: &'a Rules) -> Self {
        Refiner {
            rules,
            boundary: None,
            workers: &Serial,
        }
    }

    pub(crate) fn boundary_of(&self, mesh: &Mesh) -> Boundary {
        self.boundary.or(mesh.features.boundary).unwrap_or(Boundary::Edge)
    }

    pub(crate) fn ends(&self, mesh: &Mesh) -> Ends {
        match self.boundary_of(mesh) {
            Boundary::Edge => Ends::Rim { corners: false },
            Boundary::Corner => Ends::Rim { corners: true },
            Boundary::Shrink => Ends::Open,
        }
    }

    /// The number of points and faces after so many levels of a primal scheme, without running them.
    pub fn size(&self, mesh: &Mesh, levels: usize) -> (f64, f64) {
        let mut faces = mesh.corners().len() as f64;
        if levels == 0 {
            return (mesh.points().len() as f64, mesh.face_count() as f64);
        }
        faces *= 4_f64.powi(levels as i32 - 1);
        (faces, faces)
    }

    /// The mesh after so many levels. Unused points are left out; otherwise the points of the control mesh
    /// keep their numbers under primal schemes.
    ///
    /// # Errors
    /// [`Error::Defects`] for what is no surface, [`Error::NoRule`] where the scheme has no rules, those of
    /// the rules.
    pub fn refined(&self, mesh: &Mesh, levels: usize) -> Result<Mesh, Error> {
        if mesh.face_count() == 0 {
            return Err(Error::Empty);
        }
        Topology::new(mesh)?;
        let mesh = mesh.without_unused();
        if levels == 0 {
            return Ok(mesh);
        }
        if let Method::Even { order, .. } = self.rules.method()? {
            mesh.features.check_steps(self.rules.steps, (order / 2 - 1) as u32)?;
        }
        if let Method::Odd { .. } = self.rules.method()? {
            let boundary = self.boundary_of(&mesh);
            if levels > 1 && is_closed_and_plain(&mesh) {
                return crate::block::dual::refined(&mesh, self.rules, levels, self.workers);
            }
            let mut net = CellNet::new(mesh, boundary);
            for level in 0..levels {
                net = net.refined(self.rules, level)?;
                if net.mesh.face_count() == 0 {
                    return Err(Error::Empty);
                }
            }
            return Ok(net.mesh);
        }
        if let Some(refined) = crate::block::refined(self, &mesh, levels)? {
            return Ok(refined);
        }
        let mut mesh = mesh;
        for level in 0..levels {
            mesh = self.level(&mesh, level)?;
        }
        Ok(mesh)
    }

    /// One level of a primal scheme on a mesh that is a surface.
    pub(crate) fn level(&self, mesh: &Mesh, level: usize) -> Result<Mesh, Error> {
        let topology = Topology::unchecked(mesh);
        let rules = self.rules_on(mesh, &topology)?;
        let ends = self.ends(mesh);
        let refined = step(mesh, &topology, rules.get(), level, ends)?.mesh;
        match ends {
            Ends::Open if refined.face_count() == 0 => Err(Error::Empty),
            Ends::Open => Ok(refined.without_unused()),
            Ends::Rim { .. } => Ok(refined),
        }
    }

    /// The rules of the next level: those of Catmull-Clark until faces are quads and special vertices lie
    /// apart.
    pub(crate) fn rules_on(&self, mesh: &Mesh, topology: &Topology) -> Result<RulesOn<'a>, Error> {
        if self.follows_catmull_clark(mesh, topology)? {
            return Ok(RulesOn::First(Box::new(Rules::new(Definition::Family(
                Spec::CatmullClark,
            )))));
        }
        Ok(RulesOn::Own(self.rules))
    }

    fn follows_catmull_clark(&self, mesh: &Mesh, topology: &Topology) -> Result<bool, Error> {
        let plain = matches!(self.rules.definition(), Definition::Family(Spec::CatmullClark));
        let even = matches!(self.rules.method()?, Method::Even { .. });
        if even || (plain && self.rules.vertices().next().is_none()) {
            return Ok(false);
        }
        if !mesh.is_quads() {
            return Ok(true);
        }
        if self.rules.lists_four() {
            // every vertex is special, and no level tells them apart
            return Ok(false);
        }
        let valences = topology.valences();
        let special = |v: u32| {
            let (valence, boundary) = valences[v as usize];
            !boundary && valence > 0 && self.rules.is_special(v, valence)
        };
        Ok(isolation(mesh, topology, special) > 0)
    }

    pub(crate) fn rules(&self) -> &'a Rules {
        self.rules
    }
}

/// Whether a mesh has neither boundary nor marks.
fn is_closed_and_plain(mesh: &Mesh) -> bool {
    let topology = Topology::unchecked(mesh);
    mesh.features.is_empty() && (0..topology.edge_count() as u32).all(|edge| !topology.is_boundary(edge))
}

/// The rules of a level.
pub(crate) enum RulesOn<'a> {
    Own(&'a Rules),
    First(Box<Rules>),
}

impl RulesOn<'_> {
    pub fn get(&self) -> &Rules {
        match self {
            RulesOn::Own(rules) => rules,
            RulesOn::First(rules) => rules,
        }
    }
}
