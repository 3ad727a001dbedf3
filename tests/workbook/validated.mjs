// What Microsoft's schema says of files, in one start: validated.mjs PACKAGE FILE...
import { readFile } from "node:fs/promises";

const [home, ...files] = process.argv.slice(2);
const { default: validate } = await import(home);
const found = {};
for (const file of files) {
  found[file] = await validate(await readFile(file), file.split(".").pop(), "Microsoft365");
}
process.stdout.write(JSON.stringify(found), () => process.exit(0));
