//! From text to tree.

use super::{Fault, Kind, MAX_DEPTH, MAX_LENGTH, MAX_POWER, Node, Scope, Symbol};
use crate::Number;
use std::fmt;
use winnow::ascii::{digit0, digit1, multispace0};
use winnow::combinator::{alt, eof, opt};
use winnow::error::{ErrMode, ParserError};
use winnow::stream::{Location, Stream};
use winnow::token::{one_of, take_while};
use winnow::{LocatingSlice, ModalResult, Parser, Stateful};

type Input<'a> = Stateful<LocatingSlice<&'a str>, State<'a>>;

/// What is known on the way.
struct State<'a> {
    scope: &'a Scope,
    /// The summation variables that have a meaning here, the outermost first.
    locals: Vec<String>,
    depth: usize,
}

impl fmt::Debug for State<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "depth {}", self.depth)
    }
}

/// The tokens' own errors say only that there is none: what is accepted is said by who asked for it.
#[derive(Debug)]
struct Refused(Option<Fault>);

impl<I: Stream> ParserError<I> for Refused {
    type Inner = Self;

    fn from_input(_: &I) -> Self {
        Refused(None)
    }

    fn into_inner(self) -> Result<Self, Self> {
        Ok(self)
    }
}

type Parsed<T> = ModalResult<T, Refused>;

/// Reads a formula.
///
/// # Errors
/// What is wrong, where, and what is accepted.
pub(in crate::user) fn parse(text: &str, scope: &Scope) -> Result<Node, Fault> {
    if text.len() > MAX_LENGTH {
        let count = text.len();
        return Err(Fault::new(
            0,
            format!("a formula of {count} characters: accepted are up to {MAX_LENGTH}"),
        ));
    }
    let mut input = Stateful {
        input: LocatingSlice::new(text),
        state: State {
            scope,
            locals: Vec::new(),
            depth: 0,
        },
    };
    let parsed = whole(&mut input);
    parsed.map_err(|error| match error {
        ErrMode::Backtrack(Refused(Some(fault))) | ErrMode::Cut(Refused(Some(fault))) => fault,
        _ => Fault::new(input.current_token_start(), "accepted is a formula"),
    })
}

fn whole(input: &mut Input) -> Parsed<Node> {
    let node = expression(input)?;
    if opt(eof).parse_next(input)?.is_none() {
        return refuse(input, "an operator + - * / ^ or the end of the formula");
    }
    Ok(node)
}

/// Says what is accepted at the present place, and what is there.
fn refuse<T>(input: &mut Input, accepted: &str) -> Parsed<T> {
    let at = input.current_token_start();
    let found = match input.input.chars().next() {
        None => "the formula ends".to_owned(),
        Some(_) => {
            let rest: String = input.input.chars().take(12).collect();
            format!("'{}'", rest.escape_debug())
        }
    };
    fail(at, format!("{found}: accepted is {accepted}"))
}

fn fail<T>(at: usize, message: impl Into<String>) -> Parsed<T> {
    Err(ErrMode::Cut(Refused(Some(Fault::new(at, message)))))
}

/// One of two signs, with white space around it.
fn sign(input: &mut Input, signs: [char; 2]) -> Parsed<Option<bool>> {
    multispace0.parse_next(input)?;
    let found = opt(one_of(signs)).parse_next(input)?;
    Ok(found.map(|sign| sign == signs[1]))
}

fn demand(input: &mut Input, token: char) -> Parsed<()> {
    multispace0.parse_next(input)?;
    match opt(one_of(token)).parse_next(input)? {
        Some(_) => Ok(()),
        None => refuse(input, &format!("'{token}'")),
    }
}

/// Everything that may contain itself goes through here.
fn nested<T>(input: &mut Input, inner: impl FnOnce(&mut Input) -> Parsed<T>) -> Parsed<T> {
    if input.state.depth == MAX_DEPTH {
        let at = input.current_token_start();
        return fail(
            at,
            format!("brackets nested more than {MAX_DEPTH} deep: accepted are up to {MAX_DEPTH}"),
        );
    }
    input.state.depth += 1;
    let found = inner(input);
    input.state.depth -= 1;
    found
}

fn expression(input: &mut Input) -> Parsed<Node> {
    nested(input, |input| list(input, ['+', '-'], Kind::Sum, term))
}

fn term(input: &mut Input) -> Parsed<Node> {
    list(input, ['*', '/'], Kind::Product, factor)
}

/// Parts that are joined by one of two signs; a single part is itself.
fn list(
    input: &mut Input,
    signs: [char; 2],
    kind: impl Fn(Vec<(bool, Node)>) -> Kind,
    part: impl Fn(&mut Input) -> Parsed<Node>,
) -> Parsed<Node> {
    let first = part(input)?;
    let mut parts = Vec::new();
    while let Some(inverse) = sign(input, signs)? {
        parts.push((inverse, part(input)?));
    }
    if parts.is_empty() {
        return Ok(first);
    }
    let at = first.at;
    parts.insert(0, (false, first));
    Ok(Node { at, kind: kind(parts) })
}

fn factor(input: &mut Input) -> Parsed<Node> {
    multispace0.parse_next(input)?;
    let at = input.current_token_start();
    if let Some(negative) = sign(input, ['+', '-'])? {
        let inner = nested(input, factor)?;
        return Ok(match negative {
            true => Node {
                at,
                kind: Kind::Sum(vec![(true, inner)]),
            },
            false => inner,
        });
    }
    let base = atom(input)?;
    multispace0.parse_next(input)?;
    if opt(one_of('^')).parse_next(input)?.is_none() {
        return Ok(base);
    }
    multispace0.parse_next(input)?;
    let accepted = format!("a whole number from 0 to {MAX_POWER}");
    let place = input.current_token_start();
    let Some(digits) = opt(digit1).parse_next(input)? else {
        return refuse(input, &accepted);
    };
    match digits.parse() {
        Ok(power) if power <= MAX_POWER => Ok(Node {
            at,
            kind: Kind::Power(Box::new(base), power),
        }),
        _ => fail(place, format!("an exponent of {digits}: accepted is {accepted}")),
    }
}

fn atom(input: &mut Input) -> Parsed<Node> {
    let at = input.current_token_start();
    if opt(one_of('(')).parse_next(input)?.is_some() {
        let inner = expression(input)?;
        demand(input, ')')?;
        return Ok(inner);
    }
    if let Some(number) = opt(number).parse_next(input)? {
        let number: Number = match number.parse() {
            Ok(number) => number,
            Err(error) => return fail(at, error.to_string()),
        };
        return Ok(Node {
            at,
            kind: Kind::Number(number.rational().clone()),
        });
    }
    let Some(name) = opt(name).parse_next(input)? else {
        return refuse(input, "a number, a name, a function or '('");
    };
    let inner = |input: &mut Input| {
        demand(input, '(')?;
        let inner = expression(input)?;
        demand(input, ')')?;
        Ok(Box::new(inner))
    };
    let kind = match name.as_str() {
        "cos" => Kind::Cos(inner(input)?),
        "sin" => Kind::Sin(inner(input)?),
        "sqrt" => Kind::Sqrt(inner(input)?),
        "sum" => sum(input)?,
        "pi" => Kind::Pi,
        name => Kind::Symbol(symbol(input, name, at)?),
    };
    Ok(Node { at, kind })
}

fn number<'a>(input: &mut Input<'a>) -> Parsed<&'a str> {
    let exponent = (one_of(['e', 'E']), opt(one_of(['+', '-'])), digit1);
    let mantissa = alt(((digit1, opt(('.', digit0))).void(), ('.', digit1).void()));
    (mantissa, opt(exponent)).take().parse_next(input)
}

fn name(input: &mut Input) -> Parsed<String> {
    let first = |c: char| c.is_ascii_alphabetic() || c == '_';
    let further = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let name = (one_of(first), take_while(0.., further)).take();
    name.map(str::to_owned).parse_next(input)
}

/// `(k, x)` or `(k, a, b, x)`.
fn sum(input: &mut Input) -> Parsed<Kind> {
    demand(input, '(')?;
    multispace0.parse_next(input)?;
    let at = input.current_token_start();
    let Some(variable) = opt(name).parse_next(input)? else {
        return refuse(input, "a name for the sector, such as k");
    };
    let scope = input.state.scope;
    let taken = variable != "k"
        && (super::RESERVED.contains(&variable.as_str())
            || scope.names.contains(&variable)
            || scope.parameters.contains(&variable));
    if taken {
        return fail(
            at,
            format!("'{variable}' has a meaning already: accepted is another name, such as k"),
        );
    }
    demand(input, ',')?;
    // the bounds, if there are any, do not know the variable: read what comes with it, and again without
    let start = input.checkpoint();
    input.state.locals.push(variable);
    let first = expression(input);
    multispace0.parse_next(input)?;
    let has_bounds = first.is_ok() && opt(one_of(',')).parse_next(input)?.is_some();
    if !has_bounds {
        let body = first?;
        input.state.locals.pop();
        demand(input, ')')?;
        return Ok(Kind::Sectors {
            bounds: None,
            body: Box::new(body),
        });
    }
    let variable = input.state.locals.pop().unwrap_or_default();
    input.reset(&start);
    let from = expression(input)?;
    demand(input, ',')?;
    let to = expression(input)?;
    demand(input, ',')?;
    input.state.locals.push(variable);
    let body = expression(input)?;
    input.state.locals.pop();
    demand(input, ')')?;
    Ok(Kind::Sectors {
        bounds: Some(Box::new([from, to])),
        body: Box::new(body),
    })
}

fn symbol(input: &mut Input, name: &str, at: usize) -> Parsed<Symbol> {
    let State { scope, locals, .. } = &input.state;
    let position = |names: &[String]| names.iter().rposition(|known| known == name);
    let found = if let Some(local) = position(locals) {
        Some(Symbol::Local(local))
    } else if let Some(parameter) = position(&scope.parameters) {
        Some(Symbol::Parameter(parameter))
    } else if let Some(index) = position(&scope.names) {
        Some(Symbol::Name(index))
    } else {
        match name {
            "n" => Some(Symbol::Valence),
            "k" if scope.sector => Some(Symbol::Sector),
            "u" if scope.tension => Some(Symbol::Tension),
            _ => None,
        }
    };
    match found {
        Some(symbol) => Ok(symbol),
        None => {
            let mut accepted = vec!["n"];
            accepted.extend(scope.sector.then_some("k"));
            accepted.extend(scope.tension.then_some("u"));
            accepted.extend(locals.iter().map(String::as_str));
            accepted.extend(scope.parameters.iter().map(String::as_str));
            accepted.extend(scope.names.iter().map(String::as_str));
            accepted.extend(["pi", "cos", "sin", "sqrt", "sum"]);
            let hint = match name {
                "k" => " (k: with sector = \"k\", or within sum(k, ..))",
                "u" => " (u: with tension = .. in the file)",
                _ => "",
            };
            let shown: String = name.chars().take(40).collect();
            let text = format!("unknown name '{shown}': accepted are {}{hint}", accepted.join(", "));
            fail(at, text)
        }
    }
}
