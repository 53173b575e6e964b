// What the Khronos validator finds in a .glb file; exit code 1 where there is an error or a warning.
const { readFileSync } = require("fs");
require("gltf-validator").validateBytes(new Uint8Array(readFileSync(process.argv[2]))).then(({ issues }) => {
  console.log(`validator, ${issues.numErrors} errors, ${issues.numWarnings} warnings`);
  for (const { severity, message, pointer } of issues.messages) if (severity < 2) console.log(pointer, message);
  process.exitCode = issues.numErrors + issues.numWarnings > 0 ? 1 : 0;
});
