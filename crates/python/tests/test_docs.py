"""Every public item has a docstring with an example, and all examples run."""

import doctest
import inspect

import eigenring


def items():
    yield "eigenring", eigenring
    for name in eigenring.__all__:
        if name.startswith("__"):
            continue
        item = getattr(eigenring, name)
        yield name, item
        if inspect.isclass(item):
            for member, value in vars(item).items():
                # the attributes of an exception, and of plain results, are told by the class
                if not member.startswith("_") and name not in ("Error", "LimitPoints", "Sample"):
                    yield f"{name}.{member}", getattr(value, "__func__", value)


def test_every_item_has_an_example_that_runs():
    parser, runner = doctest.DocTestParser(), doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    without, count = [], 0
    for name, item in items():
        test = parser.get_doctest(inspect.getdoc(item) or "", {}, name, None, 0)
        if not test.examples:
            without.append(name)
        count += len(test.examples)
        runner.run(test)
    assert not without
    assert count > 50
    assert runner.summarize().failed == 0
