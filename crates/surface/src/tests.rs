//! A local matrix applied is a mesh refined: nets around a centre as meshes, for every registered scheme.
//!
//! One side is the scheme's own interpreter on a lattice ([`refine`] on a [`PointNet`], closed under
//! refinement), the other the tables of a mesh that knows only half-edges.

use crate::features::edge;
use crate::walk::locate;
use crate::{Boundary, Mesh, Point3, Refiner, Rules, Surface, Topology, shapes};
use eigenring_scheme::user::{Reading, UserScheme};
use eigenring_scheme::{Corner, Definition, Lattice, Numbering, PointNet, Scheme, Site, Spec, refine, registry};

const LEVELS: usize = 2;

fn wave(index: usize) -> [f64; 3] {
    let x = index as f64;
    [
        (1.3 * x).sin(),
        (0.7 * x + 1.0).cos(),
        (2.1 * x).sin() * (0.3 * x).cos(),
    ]
}

/// The net as a mesh: the points of the numbering, and all faces between them.
fn mesh_of(numbering: Numbering) -> Mesh {
    let sites = numbering.sites();
    let points = (0..sites.len()).map(|index| Point3::from(wave(index))).collect();
    let mut mesh = Mesh::of_points(points);
    let at = |sector: usize, x: i32, y: i32| {
        let site = Site::new(numbering.fan, sector as i64, x, y)?;
        numbering.index(site).map(|index| index as u32)
    };
    let parity = numbering.lattice.parity();
    let reach = 2 * numbering.rings as i32 + parity;
    if numbering.lattice == Lattice::Face {
        let middle: Vec<u32> = (0..numbering.fan.sectors()).filter_map(|i| at(i, 1, 1)).collect();
        mesh.push_corners(&middle);
    }
    for sector in 0..numbering.fan.sectors() {
        for (x, y) in (parity..reach)
            .step_by(2)
            .flat_map(|x| (-parity..reach).step_by(2).map(move |y| (x, y)))
        {
            let corners = [(x, y), (x + 2, y), (x + 2, y + 2), (x, y + 2)].map(|(x, y)| at(sector, x, y));
            if let [Some(a), Some(b), Some(c), Some(d)] = corners {
                mesh.push_corners(&[a, b, c, d]);
            }
        }
    }
    mesh
}

/// The largest difference after [`LEVELS`] levels, of the points that both sides have.
fn difference(scheme: &Scheme<f64>, rules: &Rules, mark: impl Fn(&mut Mesh, Numbering), boundary: Boundary) -> f64 {
    let rings = scheme.closed_rings().unwrap();
    let wide = scheme.numbering(rings + 2);
    let mut mesh = mesh_of(wide);
    mesh.features.boundary = Some(boundary);
    mark(&mut mesh, wide);
    let closed = scheme.numbering(rings);
    let sites = closed.sites();
    let mut points: Vec<[f64; 3]> = (0..sites.len()).map(wave).collect();
    for level in 0..LEVELS {
        let net = PointNet {
            numbering: closed,
            points,
        };
        points = refine(scheme.level(level), &net, &sites).unwrap();
    }
    let refined = Refiner::new(rules).refined(&mesh, LEVELS).unwrap();
    let topology = Topology::new(&refined).unwrap();
    let found = |site: Site| -> u32 {
        match closed.lattice {
            // the centre keeps its number, and its fan begins where it did
            Lattice::Vertex => locate(&topology, first_spoke(&topology), site).unwrap(),
            // the first cell is that of the face
            Lattice::Face => refined.face(0)[site.sector],
        }
    };
    let mut worst = 0.0_f64;
    for (site, point) in sites.iter().zip(&points) {
        if closed.lattice == Lattice::Face && (site.x, site.y) != (1, 1) {
            continue;
        }
        let other = refined.points()[found(*site) as usize];
        worst = worst.max((other - Point3::from(*point)).norm());
    }
    worst
}

/// The half-edge of the refined mesh along spoke 0: from the centre, whose number is 0, to the child of the
/// first edge of the control mesh's first face.
fn first_spoke(topology: &Topology) -> u32 {
    // the first face is that of sector 0, counted from the centre, and so are its children at that corner
    let fan = topology.fan(0);
    *fan.spokes.iter().min().unwrap()
}

fn rules_of(spec: &str) -> Rules {
    Rules::new(Definition::Family(spec.parse::<Spec>().unwrap()))
}

#[test]
fn closed_fans_of_all_registered_schemes() {
    for family in registry() {
        for spec in family.examples {
            let rules = rules_of(spec);
            for n in 3..=20 {
                // a mesh is regular at valence 4, whatever a scheme has there
                if n == 4 && family.name == "lambda" {
                    continue;
                }
                let scheme: Scheme<f64> = rules.definition().inner(n).unwrap();
                let boundary = if scheme.lattice() == Lattice::Face {
                    Boundary::Shrink
                } else {
                    Boundary::Edge
                };
                let worst = difference(&scheme, &rules, |_, _| {}, boundary);
                assert!(worst < 1e-13, "{spec} N = {n}: {worst:e}");
            }
        }
    }
}

fn mark_corner(mesh: &mut Mesh, vertex: u32) {
    mesh.features.corners.insert(vertex, 10.0);
}

fn mark_crease(mesh: &mut Mesh, pair: [u32; 2], sharpness: f64) {
    mesh.features.creases.insert(pair, sharpness);
}

#[test]
fn open_fans_and_creases() {
    for spec in [
        "catmull-clark",
        "lambda:optimal",
        "tension:order=4,u0=0.5",
        "tension:order=6,u0=2",
        "stam:order=8",
    ] {
        let rules = rules_of(spec);
        for n in 1..=8 {
            let corner = Corner::fan(n).unwrap();
            let scheme: Scheme<f64> = rules.definition().around(&corner).unwrap();
            let worst = difference(&scheme, &rules, |_, _| {}, Boundary::Edge);
            assert!(worst < 1e-13, "{spec} open n = {n}: {worst:e}");
            let fixed: Scheme<f64> = rules.definition().around(&corner.fixed()).unwrap();
            let worst = difference(&fixed, &rules, |mesh, _| mark_corner(mesh, 0), Boundary::Edge);
            assert!(worst < 1e-13, "{spec} corner n = {n}: {worst:e}");
        }
        for n in 3..=9 {
            let scheme: Scheme<f64> = rules.definition().around(&Corner::dart(n).unwrap()).unwrap();
            let crease = |mesh: &mut Mesh, numbering: Numbering| {
                let at = |x: i32| numbering.index(Site::new(numbering.fan, 0, x, 0).unwrap()).unwrap() as u32;
                for x in 0..numbering.rings as i32 {
                    mesh.features.creases.insert(edge(at(2 * x), at(2 * x + 2)), 10.0);
                }
            };
            let worst = difference(&scheme, &rules, crease, Boundary::Edge);
            assert!(worst < 1e-13, "{spec} dart N = {n}: {worst:e}");
        }
    }
}

#[test]
fn scheme_files_with_rules_of_their_own() {
    let one_ring = "kind = \"one-ring\"\nname = \"mine\"\n[[valence]]\nn = 5\nf1 = \"1/4\"\nf2 = 0.25\nf3 = 0.25\nd1 = 0.4\nd2 = 0.375\ne1 = 0.05\ne2 = 0.0625\nalpha = 0.3\nbeta = 0.05\n";
    // linear refinement, then twice the mean of faces and vertices: of other valences than 4 by its own
    // centre
    let passes = "kind = \"stencils\"\nname = \"means\"\n[[valence]]\nn = 5\n[[valence.pass]]\nfrom = \"vertex\"\nto = \"vertex\"\nline = [[[0, 1]], [[-2, 0.5], [2, 0.5]]]\n[[valence.pass]]\nfrom = \"vertex\"\nto = \"face\"\nline = [[[-1, 0.5], [1, 0.5]]]\n[[valence.pass]]\nfrom = \"face\"\nto = \"vertex\"\nline = [[[-1, 0.5], [1, 0.5]]]\n[[valence.pass.special]]\nat = [0, 0]\nstencil = [{ at = [1, 1], sector = \"all\", weight = 0.2 }]\n";
    for text in [one_ring, passes] {
        let file = UserScheme::parse(text, "x", Reading::Balanced).unwrap();
        let scheme: Scheme<f64> = file.scheme(5).unwrap();
        assert_eq!(scheme.fan().sectors(), 5);
        let rules = Rules::new(Definition::File(Box::new(file)));
        let worst = difference(&scheme, &rules, |_, _| {}, Boundary::Shrink);
        assert!(worst < 1e-13, "{text}: {worst:e}");
    }
}

/// What is done to the control mesh by a rigid motion happens to the result.
#[test]
fn rigid_motions_commute_with_refinement() {
    let motion = nalgebra::Isometry3::new(
        nalgebra::Vector3::new(0.3, -2.0, 1.1),
        nalgebra::Vector3::new(0.4, 1.3, -0.7),
    );
    for spec in [
        "catmull-clark",
        "doo-sabin",
        "lambda:lambda=0.5",
        "tension:order=5",
        "tension:order=6,u0=0.3",
    ] {
        let rules = rules_of(spec);
        let control = crate::shapes::propeller(5);
        let mut moved = control.clone();
        moved.points_mut().iter_mut().for_each(|point| *point = motion * *point);
        let refiner = Refiner::new(&rules);
        let (first, second) = (
            refiner.refined(&control, 3).unwrap(),
            refiner.refined(&moved, 3).unwrap(),
        );
        assert!(first.faces().eq(second.faces()));
        for (a, b) in first.points().iter().zip(second.points()) {
            assert!((motion * a - b).norm() < 1e-13, "{spec}");
        }
    }
}

/// Levels run one by one give what blocks give, and old vertices keep their numbers.
#[test]
fn blocks_are_tables_level_by_level() {
    let specs = [
        "catmull-clark",
        "lambda:optimal",
        "stam:order=4",
        "tension:order=6,u0=0.3",
        "tension:order=8,u0=2",
        "stam:order=11",
        "doo-sabin",
        "tension:order=3,u0=0.3",
        "tension:order=5,u0=2",
        "stam:order=9",
    ];
    for spec in specs {
        let rules = rules_of(spec);
        let refiner = Refiner::new(&rules);
        let dual = matches!(rules.method(), Ok(crate::rules::Method::Odd { .. }));
        let even = matches!(rules.method(), Ok(crate::rules::Method::Even { .. }));
        let mut sheet = crate::shapes::star(5, 2, crate::shapes::StarKind::Saddle);
        sheet.features.corners.insert(sheet.face(0)[0], 10.0);
        let closed = [
            crate::shapes::gear(3),
            crate::shapes::propeller(3),
            crate::shapes::tetrahedron(),
        ];
        for mut control in closed.into_iter().chain((!dual).then_some(sheet)) {
            if !dual {
                let face = control.face(0).to_vec();
                control.features.creases.insert(edge(face[0], face[1]), 10.0);
                control.features.creases.insert(edge(face[1], face[2]), 1.5);
                if even {
                    control.features.edge_steps.insert(edge(face[0], face[1]), 1);
                    let last = control.face(control.face_count() - 1).to_vec();
                    control.features.creases.insert(edge(last[0], last[1]), 10.0);
                    control.features.edge_steps.insert(edge(last[0], last[1]), 0);
                    control.features.corners.insert(last[2], 10.0);
                    control.features.vertex_steps.insert(last[2], 1);
                }
            }
            let blocks = refiner.refined(&control, 4).unwrap();
            let mut tables = control.clone();
            let mut net = crate::CellNet::new(control.clone(), Boundary::Edge);
            for level in 0..4 {
                if dual {
                    net = net.refined(&rules, level).unwrap();
                } else {
                    tables = refiner.level(&tables, level).unwrap();
                }
            }
            let tables = if dual { net.mesh } else { tables };
            assert_eq!(blocks.faces_by_size(), tables.faces_by_size());
            let features = |mesh: &Mesh| (mesh.features.creases.len(), mesh.features.edge_steps.len());
            assert_eq!(features(&blocks), features(&tables));
            let distance = farthest(blocks.points(), tables.points());
            assert!(distance < 1e-13, "{spec}: {distance}");
            if !dual {
                for vertex in 0..control.points().len() {
                    assert!(
                        (blocks.points()[vertex] - tables.points()[vertex]).norm() < 1e-14,
                        "{spec}"
                    );
                }
            }
            assert!(Topology::new(&blocks).is_ok());
        }
    }
}

/// The farthest that a point of one set lies from the other, both ways. Points are sorted by one coordinate,
/// so that few are compared.
fn farthest(a: &[Point3<f64>], b: &[Point3<f64>]) -> f64 {
    let sorted = |points: &[Point3<f64>]| {
        let mut points = points.to_vec();
        points.sort_by(|p, q| p.x.total_cmp(&q.x));
        points
    };
    let (a, b) = (sorted(a), sorted(b));
    let one_way = |from: &[Point3<f64>], to: &[Point3<f64>]| {
        let nearest = from.iter().map(|point| {
            let start = to.partition_point(|other| other.x < point.x - 1e-9);
            let near = to[start..].iter().take_while(|other| other.x < point.x + 1e-9);
            near.map(|other| (other - point).norm()).fold(f64::INFINITY, f64::min)
        });
        nearest.fold(0.0, f64::max)
    };
    one_way(&a, &b).max(one_way(&b, &a))
}

#[test]
fn a_vertex_of_valence_five_thousand_is_nothing_special() {
    let star = crate::shapes::star(5000, 1, crate::shapes::StarKind::Convex);
    let rules = rules_of("catmull-clark");
    let refined = Refiner::new(&rules).refined(&star, 1).unwrap();
    assert_eq!(refined.face_count(), 4 * 5000);
    assert!(refined.points()[0].coords.norm() < 1.0);
    // no rule of a dual scheme reaches the middle of a boundary vertex's fan that is not there
    assert!(Refiner::new(&rules_of("doo-sabin")).refined(&star, 1).is_ok());
}

#[test]
fn dual_schemes_name_what_they_have_no_rule_for() {
    let rules = rules_of("doo-sabin");
    let refiner = Refiner::new(&rules);
    let refuse = |mark: &dyn Fn(&mut Mesh)| {
        let mut mesh = crate::shapes::torus(5, 4);
        mark(&mut mesh);
        refiner.refined(&mesh, 1).unwrap_err().to_string()
    };
    let face = crate::shapes::torus(5, 4).face(0).to_vec();
    let pair = edge(face[0], face[1]);
    let dart = refuse(&|mesh| mark_crease(mesh, pair, 10.0));
    assert!(
        dart.contains("dart") && dart.contains(&format!("vertices {}, {}", pair[0], pair[1])),
        "{dart}"
    );
    let soft = refuse(&|mesh| mark_crease(mesh, pair, 3.0));
    assert!(soft.contains("below 10"), "{soft}");
    let cusp = refuse(&|mesh| mark_corner(mesh, pair[0]));
    assert!(cusp.contains("cusp"), "{cusp}");
}

#[test]
fn orders_and_tensions_out_of_range_are_refused() {
    let refused = [
        Spec::Tension { order: 6, u0: -1.0 },
        Spec::Tension { order: 6, u0: f64::NAN },
        Spec::Tension {
            order: 5,
            u0: f64::INFINITY,
        },
        Spec::Tension { order: 2, u0: 1.0 },
        Spec::Stam { order: 33 },
        Spec::Morin { u0: -2.0 },
    ];
    for spec in refused {
        let rules = Rules::new(Definition::Family(spec.clone()));
        let cube = shapes::cube();
        assert!(Refiner::new(&rules).refined(&cube, 1).is_err(), "{spec}");
        assert!(Surface::new(&cube, &rules).is_err(), "{spec}");
    }
}
