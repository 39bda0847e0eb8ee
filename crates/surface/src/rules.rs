//! Which rules hold where on a mesh: definitions, and the levels around its centres.

use crate::Error;
use eigenring_scheme::families::{catmull_clark, catmull_clark_weights, smoothing_weights, tension_at};
use eigenring_scheme::user::UserScheme;
use eigenring_scheme::{Corner, Definition, Lattice, Level, Scheme, Site, Spec, Stencil};
use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, OnceLock};

/// The scheme of a mesh: one definition, and others at single vertices. Levels are made once for each
/// definition and valence.
#[derive(Debug)]
pub struct Rules {
    definitions: Vec<Definition>,
    by_vertex: BTreeMap<u32, usize>,
    by_valence: BTreeMap<usize, usize>,
    /// In how many smoothing steps creases act that do not say so themselves.
    pub steps: Option<usize>,
    inner: Mutex<Known>,
    /// Masks of smoothing steps, by whether it is the first one, valence and level.
    masks: Mutex<HashMap<(bool, usize, usize), [f64; 3]>>,
    beside: OnceLock<Arc<Scheme<f64>>>,
}

/// Schemes by definition and valence.
type Known = HashMap<(usize, usize), Arc<Scheme<f64>>>;

/// How a scheme refines meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Method {
    /// Bicubic in one pass: Catmull-Clark, with special rules next to a vertex at most.
    Bicubic,
    /// Linear refinement and smoothing steps: even orders with the tension of the first level.
    Even { order: usize, u0: f64 },
    /// Face nets: corner cutting, then averaging; rims follow the half cells of that tension.
    Odd { u0: f64 },
    /// Other passes around vertices, from a file.
    Passes,
}

impl Rules {
    /// One definition everywhere.
    pub fn new(definition: Definition) -> Self {
        Rules {
            definitions: vec![definition],
            by_vertex: BTreeMap::new(),
            by_valence: BTreeMap::new(),
            steps: None,
            inner: Mutex::default(),
            masks: Mutex::default(),
            beside: OnceLock::new(),
        }
    }

    /// Another definition at a vertex of the control mesh.
    pub fn with_vertex(mut self, vertex: u32, definition: Definition) -> Self {
        self.definitions.push(definition);
        self.by_vertex.insert(vertex, self.definitions.len() - 1);
        self
    }

    /// The same rules for points with other numbers; `named` gives the vertex that a point was.
    pub(crate) fn renumbered(&self, named: &HashMap<u32, u32>) -> Rules {
        let own = |(&point, vertex): (&u32, &u32)| Some((point, *self.by_vertex.get(vertex)?));
        Rules {
            definitions: self.definitions.clone(),
            by_vertex: named.iter().filter_map(own).collect(),
            by_valence: self.by_valence.clone(),
            steps: self.steps,
            inner: Mutex::default(),
            masks: Mutex::default(),
            beside: OnceLock::new(),
        }
    }

    /// The same rules for meshes on which creases that act in some steps only say so themselves.
    pub(crate) fn with_all_steps(&self) -> Rules {
        Rules {
            definitions: self.definitions.clone(),
            by_vertex: self.by_vertex.clone(),
            by_valence: self.by_valence.clone(),
            steps: None,
            inner: Mutex::default(),
            masks: Mutex::default(),
            beside: OnceLock::new(),
        }
    }

    /// Whether special rules reach farther than the vertex itself.
    pub(crate) fn reaches_beyond_vertex(&self) -> bool {
        !matches!(
            self.definition(),
            Definition::Family(Spec::CatmullClark | Spec::Tension { .. } | Spec::Stam { .. } | Spec::Morin { .. })
        ) || !self.by_vertex.is_empty()
    }

    /// Another definition around all centres of a valence without one of their own.
    pub fn with_valence(mut self, valence: usize, definition: Definition) -> Self {
        self.definitions.push(definition);
        self.by_valence.insert(valence, self.definitions.len() - 1);
        self
    }

    /// The definition of all vertices without one of their own.
    pub fn definition(&self) -> &Definition {
        &self.definitions[0]
    }

    /// The vertices with definitions of their own.
    pub fn vertices(&self) -> impl Iterator<Item = u32> + '_ {
        self.by_vertex.keys().copied()
    }

    pub(crate) fn method(&self) -> Result<Method, Error> {
        let definition = self.definition();
        if let Definition::Family(spec) = definition {
            // levels are taken one by one here, so that nothing else asks
            if let Some((order, u0)) = spec.order_and_tension() {
                eigenring_scheme::families::check_parameters(order, u0)?;
            }
            return Ok(match spec.order_and_tension() {
                Some((order, u0)) if order % 2 == 0 => Method::Even { order, u0 },
                Some((_, u0)) => Method::Odd { u0 },
                None if *spec == Spec::DooSabin => Method::Odd { u0: 1.0 },
                None => Method::Bicubic,
            });
        }
        let Definition::File(file) = definition else {
            return Ok(Method::Passes);
        };
        let Some(valence) = any_valence(file) else {
            return Ok(Method::Passes);
        };
        let scheme: Scheme<f64> = file.scheme(valence)?;
        let passes = scheme.limit().passes();
        if scheme.lattice() == Lattice::Face {
            return Ok(Method::Odd { u0: 1.0 });
        }
        let single = passes.len() == 1 && passes[0].line() == Some(&eigenring_scheme::Line::cubic());
        Ok(if single { Method::Bicubic } else { Method::Passes })
    }

    /// The degree of the regular surface; `None` if it is no spline.
    pub fn degree(&self) -> Result<Option<usize>, Error> {
        let valence = match self.definition() {
            Definition::File(file) => any_valence(file).unwrap_or(4),
            Definition::Family(_) => 4,
        };
        Ok(self.definition().inner::<f64>(valence)?.degree())
    }

    /// The index of the definition at a vertex.
    fn index(&self, vertex: Option<u32>, valence: usize) -> usize {
        let own = vertex.and_then(|vertex| self.by_vertex.get(&vertex));
        own.or_else(|| self.by_valence.get(&valence)).copied().unwrap_or(0)
    }

    /// Whether a vertex, smooth and without active edges, follows rules of its own.
    pub(crate) fn is_special(&self, vertex: u32, valence: usize) -> bool {
        valence != 4 || self.by_vertex.contains_key(&vertex) || self.lists_four()
    }

    /// Whether vertices of valence 4 have rules of their own: a file lists them, and not the regular ones.
    pub fn lists_four(&self) -> bool {
        match self.definition() {
            Definition::File(file) => file.valences().any(|valence| valence == 4) && !self.four_is_regular(),
            Definition::Family(_) => false,
        }
    }

    /// Whether what a file says of valence 4 is the regular rule: then there is nothing special there.
    fn four_is_regular(&self) -> bool {
        let Ok(scheme) = self.scheme_of(0, 4) else {
            return false;
        };
        let level = scheme.limit();
        let reference = |pass: usize, site: Site| -> Option<Stencil<f64>> {
            let regular = eigenring_scheme::Pass::regular(
                level.passes()[pass].from(),
                level.passes()[pass].to(),
                level.passes()[pass].line()?.clone(),
            );
            let mut stencil = Stencil::new();
            let line = regular.line()?;
            for (x, wx) in line.taps(site.x) {
                for (y, wy) in line.taps(site.y) {
                    stencil.add(Site::new(level.fan(), site.sector as i64, x, y)?, wx * wy);
                }
            }
            Some(stencil)
        };
        (0..level.passes().len()).all(|pass| {
            level.passes()[pass].special().iter().all(|(&site, stencil)| {
                reference(pass, site).is_some_and(|regular| {
                    let weight = |of: &Stencil<f64>, at: Site| {
                        of.terms()
                            .iter()
                            .find(|(site, _)| *site == at)
                            .map_or(0.0, |term| term.1)
                    };
                    let sites = regular.terms().iter().chain(stencil.terms()).map(|(site, _)| *site);
                    let mut sites = sites;
                    sites.all(|at| (weight(&regular, at) - weight(stencil, at)).abs() < 1e-12)
                })
            })
        })
    }

    /// The scheme of a definition around an inner centre.
    fn scheme_of(&self, index: usize, valence: usize) -> Result<Arc<Scheme<f64>>, Error> {
        // the lock is held for look-ups only, and nothing in them panics
        if let Ok(map) = self.inner.lock()
            && let Some(scheme) = map.get(&(index, valence))
        {
            return Ok(Arc::clone(scheme));
        }
        let scheme = Arc::new(self.definitions[index].inner(valence)?);
        if let Ok(mut map) = self.inner.lock() {
            map.insert((index, valence), Arc::clone(&scheme));
        }
        Ok(scheme)
    }

    /// The scheme around a smooth vertex without active edges, or around the middle of a face.
    ///
    /// # Errors
    /// Those of the definition.
    pub fn inner(&self, vertex: Option<u32>, valence: usize) -> Result<Arc<Scheme<f64>>, Error> {
        let special = vertex.is_some_and(|v| self.by_vertex.contains_key(&v));
        let listed = |n| match self.definition() {
            Definition::File(file) => file.valences().any(|valence| valence == n),
            Definition::Family(_) => false,
        };
        let index = self.index(vertex, valence);
        if valence == 4 && !special && self.method()? == Method::Bicubic && !listed(4) {
            return regular();
        }
        if valence == 4 && !listed(4) && matches!(self.definition(), Definition::File(_)) {
            return self.regular_of_file();
        }
        self.scheme_of(index, valence)
    }

    /// The regular part of a file's rules: those of its first valence without special stencils.
    fn regular_of_file(&self) -> Result<Arc<Scheme<f64>>, Error> {
        let Definition::File(file) = self.definition() else {
            return regular();
        };
        let first = any_valence(file).unwrap_or(4);
        let scheme = self.scheme_of(0, first)?;
        let passes = scheme.limit().passes().iter().filter_map(|pass| {
            let line = pass.line()?.clone();
            Some(eigenring_scheme::Pass::regular(pass.from(), pass.to(), line))
        });
        let level = Level::new(eigenring_scheme::Fan::Closed(4), passes.collect())?;
        Ok(Arc::new(Scheme::stationary(scheme.name(), level)))
    }

    /// The rules of creases: the scheme on one side of a boundary with two faces.
    pub(crate) fn beside(&self) -> Result<Arc<Scheme<f64>>, Error> {
        if let Some(known) = self.beside.get() {
            return Ok(Arc::clone(known));
        }
        let definition = match self.definition() {
            // the crease rule of cubic splines, as the families have it
            Definition::File(_) => &Definition::Family(Spec::CatmullClark),
            family => family,
        };
        let made = Arc::new(definition.around(&Corner::fan(2)?)?);
        Ok(Arc::clone(self.beside.get_or_init(|| made)))
    }

    /// The smooth mask of a vertex in a smoothing pass: its own weight, that of each edge neighbour, of each
    /// face neighbour.
    pub(crate) fn mask(
        &self,
        vertex: u32,
        valence: usize,
        plain: bool,
        pass: usize,
        level: usize,
    ) -> Result<[f64; 3], Error> {
        let method = self.method()?;
        if let Method::Even { u0, .. } = method {
            let step = pass.saturating_sub(1);
            let key = (step == 0, valence, level);
            if let Some(mask) = self.masks.lock().ok().and_then(|known| known.get(&key).copied()) {
                return Ok(mask);
            }
            let mask = smoothing_weights(step, valence, tension_at(u0, level));
            if let Ok(mut known) = self.masks.lock() {
                known.insert(key, mask);
            }
            return Ok(mask);
        }
        let scheme = if plain {
            if valence == 2 && matches!(self.definition(), Definition::Family(Spec::CatmullClark)) {
                let weights = catmull_clark_weights::<f64>(2);
                let own = 1.0 - weights.alpha - weights.beta;
                return Ok([own, weights.alpha / 2.0, weights.beta / 2.0]);
            }
            self.inner(Some(vertex), valence)?
        } else {
            Arc::new(catmull_clark(valence)?)
        };
        let stencil = scheme.level(level).stencil(pass, Site::CENTRE)?;
        let weight = |x, y| {
            let site = Site { sector: 0, x, y };
            stencil
                .terms()
                .iter()
                .find(|(at, _)| *at == site)
                .map_or(0.0, |term| term.1)
        };
        Ok([weight(0, 0), weight(2, 0), weight(2, 2)])
    }
}

/// A valence that a file has rules for: the first one listed, else the first that its formulas are for.
fn any_valence(file: &UserScheme) -> Option<usize> {
    file.valences().next().or_else(|| file.rule().map(|(first, _)| first))
}

fn regular() -> Result<Arc<Scheme<f64>>, Error> {
    Ok(Arc::new(catmull_clark(4)?))
}
