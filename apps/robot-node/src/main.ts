#!/usr/bin/env node
/**
 * `farpoint-robot`: runs the robot; `init` writes a configuration, `doctor` checks everything, `release` releases the
 * emergency stop, `audit` verifies a log.
 */
const [, , command] = process.argv;
const rest = process.argv.slice(3);

// Commands load only the modules that they need. Anything still hanging when the doctor is done ends with the
// process.
if (command === 'init') process.exitCode = (await import('./program/commands/init.ts')).init(rest, process);
else if (command === 'doctor')
  process.exit(await (await import('./program/commands/doctor.ts')).doctor(rest, process));
else if (command === 'release')
  process.exitCode = await (await import('./program/commands/release.ts')).release(rest, process);
else if (command === 'audit')
  process.exitCode = (await import('@farpoint/audit')).auditCommand('farpoint-robot', rest, process);
else await (await import('./run.ts')).run();
