import fc from 'fast-check';

// Property tests use the same cases on every run; FAST_CHECK_SEED gives others.
fc.configureGlobal({ ...fc.readConfigureGlobal(), seed: Number(process.env.FAST_CHECK_SEED ?? 1) });
