// Bundles what the report's page needs into one script. SPDX-License-Identifier: Apache-2.0
// usage: node build.mjs OUT.js
import { build } from "esbuild";
import { readFileSync, writeFileSync } from "node:fs";

const out = process.argv[2] ?? "model.bundle.js";
await build({
  entryPoints: ["model.js"], bundle: true, minify: true, format: "iife", target: "es2020",
  legalComments: "none", outfile: out, logLevel: "warning",
});
// The page may not end before its script does; and the licence goes where the code goes.
const licence = readFileSync("node_modules/three/LICENSE", "utf8").replaceAll("*/", "* /");
const script = readFileSync(out, "utf8").replaceAll("</script", "<\\/script");
writeFileSync(out, "/* three.js, in this script:\n" + licence + "*/\n" + script);
