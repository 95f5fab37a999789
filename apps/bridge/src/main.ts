#!/usr/bin/env node
import { fileFault, JsonLinesFile, runProgram, setNiceness } from '@farpoint/service';
import { Bridge, monotonicMs } from './bridge.ts';
import { registerBridgeMetrics } from './metrics.ts';
import { program, toBridgeOptions } from './options.ts';

await runProgram(program, async ({ options, log, health, metrics, shutdown, serveAdmin }) => {
  try {
    setNiceness(options.niceness);
  } catch (error) {
    log.info(
      { niceness: options.niceness, reason: (error as Error).message },
      'the system keeps the priority',
    );
  }
  const bridge = await Bridge.open(toBridgeOptions(options), log, monotonicMs);
  shutdown.onClose('bridge', () => bridge.close());
  if (options.stats !== null) {
    const file = new JsonLinesFile(options.stats, (error) =>
      log.error(
        { remedy: 'set --stats to a file that can be written' },
        `statistics are not written: ${fileFault(error) ?? error.message}`,
      ),
    );
    shutdown.onClose('statistics', () => file.close());
    bridge.onFrame = (record) => file.write(record);
  }
  log.info({ host: options.host, ...bridge.ports }, 'listening for a page');
  registerBridgeMetrics(metrics, bridge);
  health.add('signaling', () => ({ ok: true, detail: { connected: bridge.signalingOpen } }));
  health.add('robots', () => ({ ok: true, detail: { known: bridge.roster.size } }));
  await serveAdmin({ host: options.adminHost, port: options.adminPort, names: options.adminNames });
});
