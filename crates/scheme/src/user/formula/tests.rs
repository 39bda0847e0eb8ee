//! **Claim**: formulas mean what their text says, in every number type; what is none is refused where it is
//! wrong, at once. **Oracle**: doubles, evaluated by hand or by the closed forms of trigonometric sums.

use super::{Bindings, Context, Fault, Residual, Scope, parse};
use crate::{Exact, Same, Scalar};
use eigenring_spline::Dual;

fn scope() -> Scope {
    Scope {
        parameters: vec!["a".into()],
        names: vec!["w".into()],
        tension: true,
        sector: true,
    }
}

/// The formula at n = 7, k = 2, with w = 1/2 and open a and u.
fn residual(text: &str) -> Result<Residual, Fault> {
    let node = parse(text, &scope())?;
    let half = Residual::Value(Exact::ratio(1, 2));
    let mut context = Context::new(7, Residual::Tension, vec![Residual::Parameter(0)], vec![Some(half)]);
    context.sector = 2;
    context.evaluate(&node)
}

fn bindings<S: Scalar>(a: S, u: S) -> Bindings<S> {
    Bindings {
        tension: u,
        parameters: vec![a],
        names: vec![None],
    }
}

#[test]
fn formulas_have_the_value_of_their_text() {
    let (a, u) = (0.3_f64, 1.7_f64);
    let c = |k: f64| (std::f64::consts::TAU * k / 7.0).cos();
    for (text, expected) in [
        ("1 + 2*3 - 4/2/2", 6.0),
        ("-2^2", -4.0),
        ("2 - -3", 5.0),
        ("- - 2", 2.0),
        ("(1+2)*(3-5)", -6.0),
        ("2.5e-1 + .5 + 1.", 1.75),
        ("n*k + w", 14.5),
        ("(3 + 2*cos(2*pi*k/n))/(4*n)", (3.0 + 2.0 * c(2.0)) / 28.0),
        ("sin(pi*3/6) + cos(-(pi)/3)", 1.5),
        (
            "cos(pi*(2*k - n)/(3*n) + pi/4)",
            (std::f64::consts::PI * (-3.0 / 21.0 + 0.25)).cos(),
        ),
        (
            "sqrt(2)*sqrt(8) + sqrt(1 + cos(pi/5))",
            4.0 + (1.0 + (std::f64::consts::PI / 5.0).cos()).sqrt(),
        ),
        ("sum(k, cos(2*pi*k/n))", 0.0),
        ("sum(j, 1, n - 1, j*j)", 91.0),
        ("sum(j, k, 4, sum(i, j, 4, i + k))", 32.0),
        (
            "a*(u + 1/u) - sqrt(a)*w",
            0.3 * (1.7 + 1.0 / 1.7) - 0.3_f64.sqrt() / 2.0,
        ),
        ("sum(k, u*cos(2*pi*k/n)^2)", 3.5 * 1.7),
        ("sqrt(3 + cos(2*pi/7))", (3.0 + c(1.0)).sqrt()),
    ] {
        let value: f64 = residual(text).unwrap().to(&bindings(a, u));
        assert!((value - expected).abs() < 1e-14, "{text}: {value}, {expected}");
    }
}

#[test]
fn derivatives_are_those_of_central_differences() {
    let formula = residual("a^3*sqrt(u + a) - cos(2*pi/n)*a/(1 + u*a)").unwrap();
    let value = |a: f64, u: f64| formula.to(&bindings(a, u));
    let dual: Dual<f64, 2> = formula.to(&bindings(Dual::variable(0.7, 0), Dual::variable(1.2, 1)));
    let step = 1e-6;
    let da = (value(0.7 + step, 1.2) - value(0.7 - step, 1.2)) / (2.0 * step);
    let du = (value(0.7, 1.2 + step) - value(0.7, 1.2 - step)) / (2.0 * step);
    assert!((dual.parts[0] - da).abs() < 1e-8 && (dual.parts[1] - du).abs() < 1e-8);
}

#[test]
fn numbers_are_exact_and_the_rest_is_compared_by_its_form() {
    for (text, value) in [
        ("sum(k, cos(2*pi*k/n)^2)", Exact::ratio(7, 2)),
        ("cos(pi/5)*cos(2*pi/5)", Exact::ratio(1, 4)),
        (
            "1/(1 + cos(2*pi/5)) - 2*(1 - cos(2*pi/5))/(2 - 2*cos(2*pi/5)^2)",
            Exact::zero(),
        ),
        ("(1/3 + 2/3)/7", Exact::ratio(1, 7)),
    ] {
        let found = residual(text).unwrap();
        assert!(
            found.exact().is_some_and(|found| found.same(&value)),
            "{text}: {found:?}"
        );
    }
    let same = |a: &str, b: &str| residual(a).unwrap().same(&residual(b).unwrap());
    assert!(same("u*cos(2*pi*k/n) + 1", "u*cos(2*pi*(n-k)/n) + 2/2"));
    assert!(same("sqrt(3 + cos(2*pi*k/n))", "sqrt(3 + cos(2*pi*(n-k)/n))"));
    assert!(!same("sqrt(3 + cos(2*pi/n))", "sqrt(3 + cos(4*pi/n))") && !same("u*a", "u*u"));
}

/// What is wrong is said at its place, and nothing takes long.
#[test]
fn bad_formulas_are_refused_at_their_place() {
    let nested = "(".repeat(1_000_000) + "1" + &")".repeat(1_000_000);
    let deep = "(".repeat(70) + "1" + &")".repeat(70);
    let signs = "-".repeat(200) + "1";
    for (text, at, needle) in [
        ("1 + ", 4, "the formula ends"),
        ("", 0, "the formula ends"),
        ("(1 + 2", 6, "accepted is ')'"),
        ("1 2", 2, "an operator"),
        ("2k", 1, "an operator"),
        ("1 + b*2", 4, "unknown name 'b': accepted are n, k, u, a, w"),
        ("cos 2", 4, "'('"),
        ("2^-1", 2, "a whole number from 0 to 64"),
        ("2^65", 2, "an exponent of 65"),
        ("2^99999999999999", 2, "an exponent"),
        ("1e99999", 0, "not a number"),
        ("sum(pi, 1)", 4, "has a meaning already"),
        ("sum(3, 1)", 4, "a name for the sector"),
        ("sum(k, 1, 2)", 11, "','"),
        ("1 $ 2", 2, "'$ 2'"),
        ("\u{e4} + 1", 0, "accepted is a number"),
        ("pi", 0, "pi alone"),
        ("2 + 1/(k - 2)", 6, "division by zero at n = 7"),
        (
            "1/(cos(2*pi/n) + cos(4*pi/n) + cos(6*pi/n) + 1/2)",
            2,
            "division by zero",
        ),
        ("sqrt(1 - 2)", 0, "square root of -1"),
        ("cos(1)", 4, "no multiple of pi"),
        ("cos(pi*pi)", 4, "in an angle"),
        ("cos(2/pi)", 4, "in an angle"),
        ("cos(a*pi)", 4, "in an angle"),
        ("cos(pi*a)", 7, "in an angle"),
        ("cos(pi/100003)", 4, "too fine"),
        ("cos(2*pi/0)", 9, "division by zero"),
        ("sum(k, 1, 1000000000, k)", 0, "a sum from 1 to 1000000000"),
        ("sum(k, 1, 1/2, k)", 10, "accepted are integers"),
        ("sum(i, 1, 99999, sum(j, 1, 99999, i*j))", usize::MAX, "too much work"),
        ("sum(i, 1, 99999, 1/i)", usize::MAX, "too much work"),
        ("((9^64)^64)^64", usize::MAX, "too much work"),
        (&nested, 0, "a formula of 2000001 characters"),
        (&deep, 64, "nested more than 64 deep"),
        (&signs, 64, "nested more than 64 deep"),
    ] {
        let shown = &text[..text.len().min(40)];
        let fault = residual(text).map(|_| ()).unwrap_err();
        assert!(fault.message.contains(needle), "{shown}: {fault:?}");
        // a bracket is as good a place as what is in it
        assert!(at == usize::MAX || at.abs_diff(fault.at) <= 4, "{shown}: {fault:?}");
        assert!(fault.message.contains("accepted"), "{shown}: {fault:?}");
    }
    // long, but shallow
    let long = vec!["1"; 4000].join(" + ");
    assert!(residual(long[..9999.min(long.len())].trim_end_matches([' ', '+'])).is_ok());
}
