"""The body of a printed function as instructions of LLVM.

What a printed function may hold is what ``PythonCode`` writes: assignments, calls, conditions, loops over ranges and
returns, with arithmetic on doubles and 64-bit integers, comparisons, elements of arrays, and functions of mathematics.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Sequence
from types import BuiltinFunctionType
from typing import Any, Protocol

import numpy as np
from llvmlite import ir
from numba import types

NUMBER, COUNT, TRUTH = ir.DoubleType(), ir.IntType(64), ir.IntType(1)
FUSED = ("contract",)
FLOATS = {ast.Add: "fadd", ast.Sub: "fsub", ast.Mult: "fmul", ast.Div: "fdiv"}
COUNTS = {ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul", ast.Mod: "srem"}
TRUTHS = {ast.BitAnd: "and_", ast.BitOr: "or_"}
COMPARED = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="}


class Unit(Protocol):
    """The functions and the global names of a module."""

    names: dict[str, Any]
    written: dict[str, ast.FunctionDef]

    def function(self, context: Any, module: ir.Module, name: str) -> Any:
        """A function of the module."""


class Statements:
    """Writes the statements of a function."""

    def __init__(self, unit: Unit, context: Any, function: ir.Function) -> None:
        self.unit, self.context, self.function = unit, context, function
        self.entry = ir.IRBuilder(function.append_basic_block("entry"))
        self.builder = ir.IRBuilder(function.append_basic_block("body"))
        self.arrays = {each.name: each for each in function.args if isinstance(each.type, ir.PointerType)}
        self.places: dict[str, Any] = {}
        for each in function.args:
            if each.name not in self.arrays:
                self._store(each.name, each)

    def write(self, body: Sequence[ast.stmt]) -> None:
        """Write the whole body."""
        self._block(body)
        if isinstance(self.function.function_type.return_type, ir.VoidType) and not self._ended:
            self.builder.ret_void()
        elif not self._ended:
            self.builder.unreachable()
        self.entry.branch(self.function.blocks[1])

    @property
    def _ended(self) -> bool:
        return bool(self.builder.block.is_terminated)

    def _block(self, body: Sequence[ast.stmt]) -> None:
        for statement in body:
            getattr(self, f"_write_{type(statement).__name__.lower()}")(statement)

    def _write_pass(self, statement: ast.Pass) -> None:
        pass

    def _write_expr(self, statement: ast.Expr) -> None:
        self._values(statement.value)

    def _write_return(self, statement: ast.Return) -> None:
        assert statement.value is not None
        kind, values = self.function.function_type.return_type, self._values(statement.value)
        if isinstance(kind, ir.LiteralStructType):
            found: Any = ir.Constant(kind, ir.Undefined)
            for place, value in enumerate(values):
                found = self.builder.insert_value(found, self._as(value, NUMBER), place)
            self.builder.ret(found)
        else:
            self.builder.ret(self._as(values[0], kind))

    def _write_assign(self, statement: ast.Assign) -> None:
        target, values = statement.targets[0], self._values(statement.value)
        for each, value in zip(target.elts if isinstance(target, ast.Tuple) else [target], values, strict=True):
            if isinstance(each, ast.Name):
                self._store(each.id, value)
            else:
                address = self._address(each)
                self.builder.store(self._as(value, address.type.pointee), address)

    def _write_if(self, statement: ast.If) -> None:
        test = self._value(statement.test)
        if not statement.orelse:
            with self.builder.if_then(test):
                self._block(statement.body)
            return
        with self.builder.if_else(test) as (then, otherwise):
            with then:
                self._block(statement.body)
            with otherwise:
                self._block(statement.orelse)

    def _write_while(self, statement: ast.While) -> None:
        self._loop(lambda: self._value(statement.test), statement.body)

    def _write_for(self, statement: ast.For) -> None:
        assert isinstance(statement.target, ast.Name) and isinstance(statement.iter, ast.Call)
        name, (first, end) = statement.target.id, [self._as(self._value(each), COUNT) for each in statement.iter.args]
        self._store(name, first)

        def go_on() -> None:
            self._store(name, self.builder.add(self._load(name), ir.Constant(COUNT, 1)))

        self._loop(lambda: self.builder.icmp_signed("<", self._load(name), end), statement.body, go_on)

    def _loop(self, test: Callable[[], Any], body: Sequence[ast.stmt], go_on: Callable[[], None] | None = None) -> None:
        head, inside, after = (self.function.append_basic_block(name) for name in ("while", "do", "after"))
        self.builder.branch(head)
        self.builder.position_at_end(head)
        self.builder.cbranch(test(), inside, after)
        self.builder.position_at_end(inside)
        self._block(body)
        if not self._ended:
            if go_on:
                go_on()
            self.builder.branch(head)
        self.builder.position_at_end(after)

    def _store(self, name: str, value: Any) -> None:
        if name not in self.places:
            self.places[name] = self.entry.alloca(value.type, name=name)
        place = self.places[name]
        self.builder.store(self._as(value, place.type.pointee), place)

    def _load(self, name: str) -> Any:
        return self.builder.load(self.places[name])

    def _as(self, value: Any, kind: ir.Type) -> Any:
        if value.type == kind:
            return value
        if value.type == COUNT and kind == NUMBER:
            return self.builder.sitofp(value, NUMBER)
        raise TypeError(f"{value.type} cannot become {kind}")

    def _value(self, node: ast.expr) -> Any:
        (found,) = self._values(node)
        return found

    def _values(self, node: ast.expr) -> list[Any]:
        if isinstance(node, ast.Tuple):
            return [self._value(each) for each in node.elts]
        if isinstance(node, ast.Call):
            return self._called(node)
        return [getattr(self, f"_of_{type(node).__name__.lower()}")(node)]

    def _of_constant(self, node: ast.Constant) -> Any:
        value: Any = node.value
        return ir.Constant(TRUTH if isinstance(value, bool) else COUNT if isinstance(value, int) else NUMBER, value)

    def _of_name(self, node: ast.Name) -> Any:
        return self._load(node.id) if node.id in self.places else ir.Constant(NUMBER, self.unit.names[node.id])

    def _of_subscript(self, node: ast.Subscript) -> Any:
        return self.builder.load(self._address(node))

    def _address(self, node: ast.expr) -> Any:
        assert isinstance(node, ast.Subscript) and isinstance(node.value, ast.Name)
        return self.builder.gep(self._array(node.value.id), [self._value(node.slice)], inbounds=True)

    def _array(self, name: str) -> Any:
        return self.arrays[name] if name in self.arrays else self._constants(name)

    def _constants(self, name: str) -> Any:
        """The first element of a constant array of the module."""
        values = np.asarray(self.unit.names[name], float)
        module, full = self.builder.module, f"{self.function.name}.{name}"
        found = module.globals.get(full)
        if found is None:
            kind = ir.ArrayType(NUMBER, values.size)
            found = ir.GlobalVariable(module, kind, full)
            found.linkage, found.global_constant = "internal", True
            found.initializer = ir.Constant(kind, [ir.Constant(NUMBER, value) for value in values.tolist()])
        zero = ir.Constant(ir.IntType(32), 0)
        return self.builder.gep(found, [zero, zero], inbounds=True)

    def _of_unaryop(self, node: ast.UnaryOp) -> Any:
        if isinstance(node.op, ast.USub) and isinstance(node.operand, ast.Constant):
            return self._of_constant(ast.Constant(-node.operand.value))  # type: ignore[operator]
        value = self._value(node.operand)
        if isinstance(node.op, ast.Not):
            return self.builder.not_(value)
        return self.builder.fneg(value) if value.type == NUMBER else self.builder.neg(value)

    def _of_binop(self, node: ast.BinOp) -> Any:
        one, other = self._value(node.left), self._value(node.right)
        operation = type(node.op)
        if one.type == TRUTH:
            return getattr(self.builder, TRUTHS[operation])(one, other)
        if one.type == other.type == COUNT and operation in COUNTS:
            return getattr(self.builder, COUNTS[operation])(one, other)
        return getattr(self.builder, FLOATS[operation])(self._as(one, NUMBER), self._as(other, NUMBER), flags=FUSED)

    def _of_compare(self, node: ast.Compare) -> Any:
        one, other, sign = self._value(node.left), self._value(node.comparators[0]), COMPARED[type(node.ops[0])]
        if one.type == other.type != NUMBER:
            return self.builder.icmp_signed(sign, one, other)
        compared = self.builder.fcmp_unordered if sign == "!=" else self.builder.fcmp_ordered
        return compared(sign, self._as(one, NUMBER), self._as(other, NUMBER))

    def _of_ifexp(self, node: ast.IfExp) -> Any:
        test = self._value(node.test)
        if not any(isinstance(each, ast.Call) for part in (node.body, node.orelse) for each in ast.walk(part)):
            return self.builder.select(test, self._value(node.body), self._value(node.orelse))
        with self.builder.if_else(test) as (then, otherwise):  # what is long is computed where it is needed
            with then:
                first, left = self._value(node.body), self.builder.block
            with otherwise:
                second, right = self._value(node.orelse), self.builder.block
        found = self.builder.phi(first.type)
        found.add_incoming(first, left)
        found.add_incoming(second, right)
        return found

    def _called(self, node: ast.Call) -> list[Any]:
        if isinstance(node.func, ast.Attribute):  # a count that is no literal
            return [self._value(node.args[0])]
        assert isinstance(node.func, ast.Name)
        name = node.func.id
        if name in self.unit.written:
            return self._called_here(name, node.args)
        function, values = self.unit.names[name], [self._value(each) for each in node.args]
        if isinstance(function, BuiltinFunctionType):
            return [self._mathematics(function, [self._as(each, NUMBER) for each in values])]
        found: list[Any] = function.generate(self.builder, values)
        return found

    def _called_here(self, name: str, arguments: Sequence[ast.expr]) -> list[Any]:
        function = self.unit.function(self.context, self.builder.module, name)
        passed = [
            self._array(each.id) if isinstance(each, ast.Name) and each.id in self.arrays else self._value(each)
            for each in arguments
        ]
        kinds = function.function_type.args
        found = self.builder.call(function, [self._as(*each) for each in zip(passed, kinds, strict=True)])
        if isinstance(found.type, ir.LiteralStructType):
            return [self.builder.extract_value(found, place) for place in range(len(found.type.elements))]
        return [found]

    def _mathematics(self, function: Any, values: Sequence[Any]) -> Any:
        if function is math.fabs:
            kind = ir.FunctionType(NUMBER, [NUMBER])
            return self.builder.call(self.builder.module.declare_intrinsic("llvm.fabs", [NUMBER], kind), values)
        signature = types.float64(*[types.float64] * len(values))
        return self.context.get_function(function, signature)(self.builder, values)
