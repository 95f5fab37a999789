import fc from 'fast-check';

// Properties meet the same cases on every run; FAST_CHECK_SEED shows them others.
fc.configureGlobal({ ...fc.readConfigureGlobal(), seed: Number(process.env.FAST_CHECK_SEED ?? 1) });
