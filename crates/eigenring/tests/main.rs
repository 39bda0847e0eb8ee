//! The command as its users see it: output, files and exit codes, run as a process. One binary, since linking
//! takes longer than running.

mod common;
mod contract;
mod corners;
mod curve;
mod destinations;
mod errors;
mod formulas;
mod nonuniform;
mod on_demand;
mod own_matrices;
mod plot;
mod report;
mod stored_certificates;
mod surfaces;
mod tables;
mod tension;
mod tune_files;
mod verify;
