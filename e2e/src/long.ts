/** Tag of tests that take long and have shorter siblings. Only `pnpm test --all` runs them. */
export const LONG = '@long';

/** Whether they run: set by `pnpm test --all`, or by hand. */
export const runsLong = (process.env.FARPOINT_LONG_TESTS ?? '') !== '';
