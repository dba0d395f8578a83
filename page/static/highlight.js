// Colours for the texts: enough to read by, in Rust, WGSL, GLSL, HLSL and MSL alike.

const KEYWORDS = new Set(
  ("as break case cbuffer const constant continue default discard do else enum false fn for if impl in inout kernel let loop " +
    "match mod mut out override pub ref return select self static struct switch thread trait true type uniform use using var " +
    "void while where layout precision highp register numthreads namespace fragment vertex compute").split(" "),
);
const TYPES =
  /^(bool|float|half|int|uint|[fiu](8|16|32|64)|usize|[IUB]?Vec[234]|Mat[234]|vec[234][fiuh]?|[iub]?vec[234]|mat[234](x[234])?f?|(float|int|uint|half)[1234](x[1234])?|texture\w*|sampler\w*|[iu]?sampler\w+|image2D|Texture\w*|SamplerState|RWTexture\w*|array|ptr|Frame\w*|Quad|Sampler)$/;
const TOKEN =
  /(\/\/[^\n]*|\/\*[\s\S]*?\*\/)|(^[ \t]*#[^\n]*|@\w+(?:\([^)\n]*\))?)|(\b(?:0x[\da-f]+|\d[\d_]*(?:\.(?!\.)[\d_]*)?(?:e[+-]?\d+)?)\w*)|("(?:[^"\\\n]|\\.)*")|([A-Za-z_]\w*)(?=(\s*\()?)/gim;

const escape = (text) => text.replace(/[&<>]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;" })[c]);

/** The text as HTML, a `span` around each coloured word. */
export function highlight(text) {
  let html = "";
  let last = 0;
  for (const match of text.matchAll(TOKEN)) {
    const [all, comment, directive, number, string, word, called] = match;
    let kind = null;
    if (comment) kind = "c";
    else if (directive) kind = "d";
    else if (number) kind = "n";
    else if (string) kind = "s";
    else if (KEYWORDS.has(word)) kind = "k";
    else if (TYPES.test(word)) kind = "t";
    else if (called) kind = "f";
    html += escape(text.slice(last, match.index));
    html += kind ? `<span class="${kind}">${escape(all)}</span>` : escape(all);
    last = match.index + all.length;
  }
  return html + escape(text.slice(last));
}
