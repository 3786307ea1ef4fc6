"""Writes scenes (nested dictionaries) as TOML: top-level tables as blocks, deeper ones inline."""
import json


def literal(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {literal(v)}" for key, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(literal(v) for v in value) + "]"
    return repr(value)


def is_tables(value):
    return isinstance(value, list) and bool(value) and all(isinstance(v, dict) for v in value)


def block(title, table):
    """A table under its title; lists of tables in it become blocks of their own."""
    lines = [title] if title else []
    lines += [f"{key} = {literal(v)}" for key, v in table.items() if not is_tables(v)]
    inner = [block(f"[[{title.strip('[]')}.{key}]]", entry)
             for key, v in table.items() if is_tables(v) for entry in v]
    return "\n".join(lines + inner)


def to_toml(scene):
    plain = {key: v for key, v in scene.items() if not isinstance(v, dict) and not is_tables(v)}
    parts = [f"{key} = {literal(v)}" for key, v in plain.items()]
    for key, value in scene.items():
        if isinstance(value, dict):
            parts.append(block(f"[{key}]", value))
        elif is_tables(value):
            parts += ["\n".join([f"[[{key}]]"] + [f"{k} = {literal(v)}" for k, v in entry.items()]) for entry in value]
    return "\n".join(parts) + "\n"
