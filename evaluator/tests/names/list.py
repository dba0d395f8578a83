#!/usr/bin/env python3
"""Lists the public names of Rust's types and of glam's, with their signatures: `list.py > names.txt`.

Rust's names are read from its documentation (`rustup component add rust-docs`), glam's from its source in cargo's registry.
Names that need a nightly compiler are left out, as are implementations of traits.
"""

import glob
import html
import os
import re
import subprocess

PAGES = {
    "f32": "primitive.f32",
    "i32": "primitive.i32",
    "u32": "primitive.u32",
    "bool": "primitive.bool",
    "array": "primitive.array",
    "slice": "primitive.slice",
    "Range": "ops/struct.Range",
    "RangeInclusive": "ops/struct.RangeInclusive",
    "Option": "option/enum.Option",
    "Result": "result/enum.Result",
    "Iterator": "iter/trait.Iterator",
    "mem": None,
}

GLAM = {
    "f32/vec2.rs f32/vec3.rs f32/scalar/vec4.rs": ["Vec2", "Vec3", "Vec4"],
    "i32/ivec2.rs i32/ivec3.rs i32/ivec4.rs": ["IVec2", "IVec3", "IVec4"],
    "u32/uvec2.rs u32/uvec3.rs u32/uvec4.rs": ["UVec2", "UVec3", "UVec4"],
    "bool/bvec2.rs bool/bvec3.rs bool/bvec4.rs": ["BVec2", "BVec3", "BVec4"],
    "f32/scalar/mat2.rs f32/mat3.rs f32/scalar/mat4.rs": ["Mat2", "Mat3", "Mat4"],
    "f32/scalar/quat.rs f32/affine2.rs f32/affine3a.rs": ["Quat", "Affine2", "Affine3A"],
}


def tidy(signature):
    signature = re.sub(r"\s+", " ", signature)
    signature = re.sub(r"\b(pub|const|unsafe|extern \"C\") ", "", signature)
    signature = re.sub(r", \)", ")", signature).replace("( ", "(")
    signature = re.sub(r"\s*ⓘ.*|\s*\bwhere .*|(?<=[a-z>)])where .*", "", signature)
    return signature.strip().rstrip(",")


def documented(path):
    """Names of a page of Rust's documentation, without those of traits."""
    page = open(path, encoding="utf-8").read()
    if "trait." not in os.path.basename(path):
        page = re.split(r'id="trait-implementations"', page)[0]
    for part in re.split(r'<section id="', page)[1:]:
        found = re.match(r'(method|tymethod|associatedconstant)\.([A-Za-z_0-9]+)"', part)
        header = re.search(r'<h4 class="code-header">(.*?)</h4>', part, re.S)
        if not found or not header or "stab unstable" in part.split("</summary>")[0] + part[:3000].split("docblock")[0]:
            continue
        if "stab deprecated" in part[:3000].split("docblock")[0]:
            continue
        text = tidy(html.unescape(re.sub(r"<[^>]*>", "", header.group(1))))
        yield text


def written(path, of):
    """Names of the inherent implementations of a glam source."""
    inside, skipped = False, False
    text = open(path, encoding="utf-8").read()
    blocks = re.findall(rf"^impl {of} \{{\n(.*?)^\}}", text, re.S | re.M)
    for block in blocks:
        for item in re.finditer(
            r"((?:^    (?:///|#\[)[^\n]*\n)*)^    pub (const )?(?:const )?(fn [^{]*|[A-Z][A-Z0-9_]*: [^=]*)", block, re.S | re.M
        ):
            before, declared = item.group(1), item.group(3)
            if "doc(hidden)" in before or "deprecated" in before or "cfg(feature" in before:
                continue
            yield tidy(("const " if item.group(2) and not declared.startswith("fn") else "") + declared)


def main():
    sysroot = subprocess.check_output(["rustc", "--print", "sysroot"], text=True).strip()
    docs = os.path.join(sysroot, "share/doc/rust/html/std")
    if not os.path.isdir(docs):
        docs = sorted(glob.glob(os.path.expanduser("~/.rustup/toolchains/*/share/doc/rust/html/std")))[-1]
    source = sorted(glob.glob(os.path.expanduser("~/.cargo/registry/src/*/glam-0.34*/src")))[-1]
    version = re.search(r"(\d+\.\d+\.\d+)-", docs)
    print(f"# Rust {version.group(1) if version else 'stable'}, {os.path.basename(os.path.dirname(source))}; made by list.py")
    for of, page in PAGES.items():
        names = ["fn swap(x: &mut T, y: &mut T)", "fn replace(dest: &mut T, src: T) -> T", "fn take(dest: &mut T) -> T"]
        for text in documented(os.path.join(docs, page + ".html")) if page else names:
            print(f"{of}: {text}")
    for files, types in GLAM.items():
        for file, of in zip(files.split(), types):
            for text in written(os.path.join(source, file), of):
                print(f"{of}: {text}")


main()
