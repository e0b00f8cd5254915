// The Khronos validator on files: prints every issue and a line per file; exit code 1 where a file has an error or a warning.
import { readFileSync } from "node:fs";
import validator from "gltf-validator";

const kSeverity = ["error", "warning", "info", "hint"];
let bad = 0;
for (const file of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 20 });
  for (const issue of report.issues.messages) {
    console.log(`${file}: ${kSeverity[issue.severity]}: ${issue.code} at ${issue.pointer ?? issue.offset}: ${issue.message}`);
  }
  const { numErrors: errors, numWarnings: warnings } = report.issues;
  console.log(`${file}: ${errors} errors, ${warnings} warnings, ${report.info?.animationCount ?? 0} animations`);
  if (errors + warnings > 0) bad = 1;
}
process.exitCode = bad;
