import { defineConfig } from 'vitest/config';

const ROOMS = '{packages,apps,tools,wasm-codec,bench,scripts}';
const STACK = `${ROOMS}/**/*.stack.test.ts`;
/**
 * Beside other work, the two implementations of DDS lose each other's packets for minutes, and an operator's commands
 * come too late for a robot to go on.
 */
const ALONE = ['packages/dds/**/*.stack.test.ts', 'apps/robot-node/src/fault-table.stack.test.ts'];
const SCENARIO = `${ROOMS}/**/*.scenario.test.ts`;
const NOT_OURS = ['**/node_modules/**', '**/dist/**', '**/target/**'];
/** Files that `pnpm test` leaves out, because they have passed with the same inputs. `--exclude` is not for projects. */
const PASSED = (process.env.FARPOINT_PASSED_TESTS ?? '').split('\n').filter((file) => file !== '');

export default defineConfig({
  test: {
    // No test measures time: a busy machine must not fail one.
    testTimeout: 30_000,
    // Node's own loader runs the sources as the programs do, and their hot loops as fast.
    experimental: { viteModuleRunner: false },
    projects: [
      {
        extends: true,
        test: {
          name: 'pure',
          include: [`${ROOMS}/**/*.test.ts`],
          exclude: [...NOT_OURS, STACK, SCENARIO],
          setupFiles: [
            'scripts/lib/test-setup.ts',
            'scripts/lib/pure-guard.ts',
            'apps/webxr/src/testing/speak-english.ts',
          ],
          // Nothing to isolate: modules are loaded once for all files, which is most of the time.
          isolate: false,
          // A process of its own, because a thread takes no options of the engine: fewer and larger collections of what is new.
          pool: 'forks',
          execArgv: ['--max-semi-space-size=64'],
          // Vitest's default leaves one core idle: of two, that is half.
          maxWorkers: '100%',
        },
      },
      {
        extends: true,
        test: {
          name: 'scenario',
          include: [SCENARIO],
          exclude: NOT_OURS,
          setupFiles: ['scripts/lib/test-setup.ts', 'tools/scenario/src/keep-logs.ts'],
          pool: 'threads',
          maxWorkers: '100%',
        },
      },
      {
        extends: true,
        test: {
          name: 'stack',
          include: [STACK],
          exclude: [...NOT_OURS, ...ALONE, ...PASSED],
          setupFiles: ['scripts/lib/test-setup.ts'],
          // These tests mostly wait for a process or a timer, so one file per core leaves none idle.
          maxWorkers: '100%',
        },
      },
      {
        extends: true,
        test: {
          name: 'stack-alone',
          include: ALONE,
          exclude: [...NOT_OURS, ...PASSED],
          setupFiles: ['scripts/lib/test-setup.ts'],
          maxWorkers: 1,
          // After the others, not beside them.
          sequence: { groupOrder: 1 },
        },
      },
    ],
  },
});
