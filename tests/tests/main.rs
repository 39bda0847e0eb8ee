//! All tests of this package as one binary: each file is a claim with its oracle, and linking them one by one
//! takes longer than running them.

mod analysis_results;
mod cases;
mod contradictions;
mod corner_certificates;
mod corners;
mod curves;
mod curves_exact;
mod embedded_table;
mod formula_ranges;
mod formula_schemes;
mod generated;
mod index;
mod lambda_studies;
mod limits;
mod nonuniform_results;
mod numbering_picture;
mod objective_reference;
mod optimality;
mod oracle;
mod paper_table_1;
mod registry;
mod regular_part;
mod results_and_paper;
mod stencil_reference;
mod surface_results;
mod tension_reductions;
mod tension_reference;
mod tension_results;
mod user_schemes;
