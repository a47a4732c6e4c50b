// A client of another vendor: asks graspd over Cyclone DDS, by topic or by the service as
// rmw_cyclonedds does, or listens to its replies. Prints one line for each reply.
//
//     cyclone_client topic|service --domain N --id ID --client CID --faces N [--gripper NAME]
//                    [--budget S] [--timeout S] [--retries N] [--depth N]
//     cyclone_client listen --domain N --count N [--timeout S]
//
// Ends with 0 when the terminal reply came (or all that were listened for), 4 when not, 2 for wrong
// usage, 1 when the middleware fails.

#include <dds/dds.h>
#include <inttypes.h>
#include <malloc.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cyclone_service.h"

typedef graspd_msgs_msg_dds__GraspRequest_ Request;
typedef graspd_msgs_msg_dds__RankedGrasps_ Reply;
typedef graspd_test_ServiceRequest ServiceRequest;
typedef graspd_test_ServiceReply ServiceReply;
typedef shape_msgs_msg_dds__Mesh_ Mesh;

enum { kDone = 0, kMiddlewareFailed = 1, kWrongUsage = 2, kNoReply = 4 };
enum { kBoxFaces = 12 };

typedef struct {
    enum { kTopic, kService, kListen } mode;
    dds_domainid_t domain;
    const char* client_id;
    const char* request_id;
    const char* gripper;
    uint32_t faces;
    double budget_s;   // [s] options.time_budget; 0: no options
    double timeout_s;  // [s] for each attempt, or for all that is listened for
    int retries;
    int count;  // replies to listen for
    int depth;  // samples that the service's ends keep; 0: all
} Arguments;

typedef struct {
    dds_entity_t writer;
    dds_entity_t reader;
    dds_entity_t waitset;
} Ends;

static _Noreturn void fail(int code, const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fputs("cyclone_client: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(code);
}

static dds_entity_t checked(dds_entity_t result, const char* what) {
    if (result < 0) fail(kMiddlewareFailed, "%s: %s", what, dds_strretcode(-result));
    return result;
}

static void* allocated(size_t bytes) {
    void* memory = calloc(1, bytes);
    if (memory == NULL) fail(kMiddlewareFailed, "no memory for %zu bytes", bytes);
    return memory;
}

// ---- the object ---------------------------------------------------------------------------------

static Mesh mesh_of(uint32_t vertices, uint32_t triangles) {
    Mesh mesh = {0};
    mesh.vertices._maximum = vertices;
    mesh.vertices._buffer = allocated(vertices * sizeof(*mesh.vertices._buffer));
    mesh.triangles._maximum = triangles;
    mesh.triangles._buffer = allocated(triangles * sizeof(*mesh.triangles._buffer));
    return mesh;
}

static void add_vertex(Mesh* mesh, double x, double y, double z) {
    mesh->vertices._buffer[mesh->vertices._length++] =
        (geometry_msgs_msg_dds__Point_){.x = x, .y = y, .z = z};
}

static void add_triangle(Mesh* mesh, uint32_t a, uint32_t b, uint32_t c) {
    mesh->triangles._buffer[mesh->triangles._length++] =
        (shape_msgs_msg_dds__MeshTriangle_){.vertex_indices = {a, b, c}};
}

// 40 x 60 x 80 mm. Vertex 4x + 2y + z stands at the higher end of the axes whose bit is set.
static Mesh box(void) {
    static const uint32_t kSides[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                          {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    Mesh mesh = mesh_of(8, kBoxFaces);
    for (int i = 0; i < 8; ++i) {
        add_vertex(&mesh, i & 4 ? 0.02 : -0.02, i & 2 ? 0.03 : -0.03, i & 1 ? 0.04 : -0.04);
    }
    for (int i = 0; i < 6; ++i) {
        add_triangle(&mesh, kSides[i][0], kSides[i][1], kSides[i][2]);
        add_triangle(&mesh, kSides[i][0], kSides[i][2], kSides[i][3]);
    }
    return mesh;
}

// Radius 30 mm, by latitude and longitude: `bands` bands of twice as many segments, so that
// 4 bands (bands - 1) comes closest to `faces`.
static Mesh sphere(uint32_t faces) {
    const double kPi = 3.14159265358979323846, kRadius_m = 0.03;
    const uint32_t bands = (uint32_t)lround(0.5 + 0.5 * sqrt(1.0 + faces));
    const uint32_t segments = 2 * bands, south = 1 + (bands - 1) * segments;
    Mesh mesh = mesh_of(south + 1, 2 * segments * (bands - 1));
    add_vertex(&mesh, 0, 0, kRadius_m);
    for (uint32_t ring = 1; ring < bands; ++ring) {
        const double polar = kPi * ring / bands;
        for (uint32_t i = 0; i < segments; ++i) {
            const double around = 2 * kPi * i / segments;
            add_vertex(&mesh, kRadius_m * sin(polar) * cos(around),
                       kRadius_m * sin(polar) * sin(around), kRadius_m * cos(polar));
        }
    }
    add_vertex(&mesh, 0, 0, -kRadius_m);
    for (uint32_t i = 0; i < segments; ++i) {
        const uint32_t next = (i + 1) % segments, last = south - segments;
        add_triangle(&mesh, 0, 1 + i, 1 + next);
        add_triangle(&mesh, south, last + next, last + i);
        for (uint32_t above = 1; above < last; above += segments) {
            const uint32_t below = above + segments;
            add_triangle(&mesh, above + i, below + i, below + next);
            add_triangle(&mesh, above + i, below + next, above + next);
        }
    }
    return mesh;
}

static Request make_request(const Arguments* arguments) {
    Request request = {.header.frame_id = "object",
                       .client_id = (char*)arguments->client_id,
                       .request_id = (char*)arguments->request_id,
                       .object_key = "",
                       .cloud.header.frame_id = "",
                       .gripper = (char*)arguments->gripper,
                       .obstacle_cloud.header.frame_id = ""};
    request.mesh = arguments->faces <= kBoxFaces ? box() : sphere(arguments->faces);
    if (arguments->budget_s > 0) {
        request.options._buffer = allocated(sizeof(*request.options._buffer));
        request.options._buffer->time_budget = arguments->budget_s;
        request.options._buffer->friction = 0.6;
        request.options._length = request.options._maximum = 1;
    }
    return request;
}

// ---- the middleware -----------------------------------------------------------------------------

// The descriptor under another DDS type name. Its type information would tell the old name.
static dds_entity_t make_topic(dds_entity_t participant, const dds_topic_descriptor_t* described,
                               const char* type_name, const char* topic) {
    const dds_topic_descriptor_t named = {
        .m_size = described->m_size,
        .m_align = described->m_align,
        .m_flagset = described->m_flagset & ~(uint32_t)DDS_TOPIC_XTYPES_METADATA,
        .m_typename = type_name,
        .m_nops = described->m_nops,
        .m_ops = described->m_ops,
        .m_meta = described->m_meta,
        .restrict_data_representation = described->restrict_data_representation};
    return checked(dds_create_topic(participant, &named, topic, NULL, NULL), topic);
}

static dds_qos_t* make_qos(int depth, bool late_joiner) {
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(10));
    dds_qset_history(qos, depth > 0 ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL, depth);
    dds_qset_durability(qos,
                        late_joiner ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    return qos;
}

// A status that is never read stays and wakes for ever: nothing else may be in the masks.
static void wake_by(const Ends* ends, uint32_t writer_status, uint32_t reader_status) {
    dds_set_status_mask(ends->writer, writer_status);
    dds_set_status_mask(ends->reader, reader_status);
}

// Topics: requests volatile, replies for late readers, everything kept. The service as rmw has it:
// both volatile, the last `depth` kept.
static Ends make_ends(dds_entity_t participant, const Arguments* arguments) {
    const bool service = arguments->mode == kService;
    const int depth = service ? arguments->depth : 0;
    dds_qos_t* written = make_qos(depth, false);
    dds_qos_t* read = make_qos(depth, !service);
    Ends ends = {0};
    if (service) {
        ends.writer = dds_create_writer(participant,
                                        make_topic(participant, &graspd_test_ServiceRequest_desc,
                                                   "graspd_msgs::srv::dds_::PlanGrasps_Request_",
                                                   "rq/graspd/plan_graspsRequest"),
                                        written, NULL);
        ends.reader = dds_create_reader(participant,
                                        make_topic(participant, &graspd_test_ServiceReply_desc,
                                                   "graspd_msgs::srv::dds_::PlanGrasps_Response_",
                                                   "rr/graspd/plan_graspsReply"),
                                        read, NULL);
    } else {
        // As they come from idlc, type information and all.
        ends.reader = dds_create_reader(
            participant,
            checked(dds_create_topic(participant, &graspd_msgs_msg_dds__RankedGrasps__desc,
                                     "rt/graspd/ranked_grasps", NULL, NULL),
                    "a topic"),
            read, NULL);
        ends.writer = dds_create_writer(
            participant,
            checked(dds_create_topic(participant, &graspd_msgs_msg_dds__GraspRequest__desc,
                                     "rt/graspd/grasp_request", NULL, NULL),
                    "a topic"),
            written, NULL);
    }
    checked(ends.writer, "a writer");
    checked(ends.reader, "a reader");
    dds_delete_qos(written);
    dds_delete_qos(read);
    ends.waitset = checked(dds_create_waitset(participant), "a waitset");
    dds_waitset_attach(ends.waitset, ends.writer, 0);
    dds_waitset_attach(ends.waitset, ends.reader, 0);
    wake_by(&ends, 0, DDS_DATA_AVAILABLE_STATUS);
    return ends;
}

static bool waits(const Ends* ends, dds_time_t end) {
    return checked(dds_waitset_wait_until(ends->waitset, NULL, 0, end), "waiting") > 0;
}

static bool matches(const Ends* ends, dds_time_t end) {
    dds_publication_matched_status_t readers = {0};
    dds_subscription_matched_status_t writers = {0};
    bool matched = false;
    wake_by(ends, DDS_PUBLICATION_MATCHED_STATUS, DDS_SUBSCRIPTION_MATCHED_STATUS);
    do {
        dds_get_publication_matched_status(ends->writer, &readers);
        dds_get_subscription_matched_status(ends->reader, &writers);
        matched = readers.current_count > 0 && writers.current_count > 0;
    } while (!matched && waits(ends, end));
    wake_by(ends, 0, DDS_DATA_AVAILABLE_STATUS);
    return matched;
}

static void print(const Reply* reply, double latency_ms) {
    printf("status=%d grasps=%" PRIu32 " attempt=%" PRIu32 " latency_ms=%.1f id=%s client=%s\n",
           reply->status, reply->grasps._length, reply->attempt, latency_ms, reply->request_id,
           reply->client_id);
    fflush(stdout);
}

// ---- the modes ----------------------------------------------------------------------------------

/// @return the next sample, or NULL; to be given back by dds_return_loan
static void* take(dds_entity_t reader) {
    for (;;) {
        void* sample = NULL;
        dds_sample_info_t info;
        if (checked(dds_take(reader, &sample, &info, 1, 1), "dds_take") == 0) return NULL;
        if (info.valid_data) return sample;
        dds_return_loan(reader, &sample, 1);
    }
}

static const Reply* own_reply(const void* sample, const ServiceRequest* call, bool service) {
    if (service) {
        const ServiceReply* answer = sample;
        const bool own =
            answer->guid == call->guid && answer->sequence_number == call->sequence_number;
        return own ? &answer->reply : NULL;
    }
    const Reply* reply = sample;
    const bool own = strcmp(reply->client_id, call->request.client_id) == 0 &&
                     strcmp(reply->request_id, call->request.request_id) == 0;
    return own ? reply : NULL;
}

// A retry is the same request again; as a call of the service it has a number of its own.
static int ask(const Ends* ends, const Arguments* arguments) {
    const bool service = arguments->mode == kService;
    ServiceRequest call = {.request = make_request(arguments)};
    dds_instance_handle_t handle = 0;
    dds_get_instance_handle(ends->writer, &handle);  // 64 bits that differ for every writer
    call.guid = handle;
    if (!matches(ends, dds_time() + DDS_SECS(10))) fail(kNoReply, "no planner within 10 s");
    for (int attempt = 0; attempt <= arguments->retries; ++attempt) {
        const dds_time_t start = dds_time();
        const dds_time_t end = start + (dds_duration_t)(arguments->timeout_s * 1e9);
        ++call.sequence_number;
        const void* sample = service ? (const void*)&call : (const void*)&call.request;
        checked(dds_write(ends->writer, sample), "dds_write");
        do {
            void* taken = NULL;
            while ((taken = take(ends->reader)) != NULL) {
                const Reply* reply = own_reply(taken, &call, service);
                if (reply != NULL) print(reply, 1e-6 * (double)(dds_time() - start));
                dds_return_loan(ends->reader, &taken, 1);
                if (reply != NULL) return kDone;
            }
        } while (waits(ends, end));
    }
    fprintf(stderr, "cyclone_client: no reply to %d attempts\n", arguments->retries + 1);
    return kNoReply;
}

static int listen_to_all(const Ends* ends, const Arguments* arguments) {
    const dds_time_t start = dds_time();
    const dds_time_t end = start + (dds_duration_t)(arguments->timeout_s * 1e9);
    int seen = 0;
    do {
        void* taken = NULL;
        while (seen < arguments->count && (taken = take(ends->reader)) != NULL) {
            print(taken, 1e-6 * (double)(dds_time() - start));
            dds_return_loan(ends->reader, &taken, 1);
            ++seen;
        }
    } while (seen < arguments->count && waits(ends, end));
    return seen >= arguments->count ? kDone : kNoReply;
}

static Arguments parse(int argc, char** argv) {
    Arguments to = {.client_id = "cyclone",
                    .request_id = "1",
                    .gripper = "parallel_85",
                    .faces = kBoxFaces,
                    .timeout_s = 10,
                    .count = 1,
                    .depth = 10};
    if (argc < 2 || argc % 2 != 0) fail(kWrongUsage, "topic, service or listen; options in pairs");
    if (strcmp(argv[1], "topic") == 0)
        to.mode = kTopic;
    else if (strcmp(argv[1], "service") == 0)
        to.mode = kService;
    else if (strcmp(argv[1], "listen") == 0)
        to.mode = kListen;
    else
        fail(kWrongUsage, "%s is no mode", argv[1]);
    for (int i = 2; i < argc; i += 2) {
        const char* name = argv[i];
        const char* value = argv[i + 1];
        if (strcmp(name, "--domain") == 0)
            to.domain = (dds_domainid_t)strtoul(value, NULL, 10);
        else if (strcmp(name, "--id") == 0)
            to.request_id = value;
        else if (strcmp(name, "--client") == 0)
            to.client_id = value;
        else if (strcmp(name, "--gripper") == 0)
            to.gripper = value;
        else if (strcmp(name, "--faces") == 0)
            to.faces = (uint32_t)strtoul(value, NULL, 10);
        else if (strcmp(name, "--budget") == 0)
            to.budget_s = strtod(value, NULL);
        else if (strcmp(name, "--timeout") == 0)
            to.timeout_s = strtod(value, NULL);
        else if (strcmp(name, "--retries") == 0)
            to.retries = atoi(value);
        else if (strcmp(name, "--count") == 0)
            to.count = atoi(value);
        else if (strcmp(name, "--depth") == 0)
            to.depth = atoi(value);
        else
            fail(kWrongUsage, "%s is no option", name);
    }
    return to;
}

int main(int argc, char** argv) {
    // Cyclone DDS serializes into a buffer that grows by 4 kB. Where it is mapped, each step may move
    // all of it: 50 MB took between 1 and 10 s. On the heap it grows in place.
    mallopt(M_MMAP_THRESHOLD, 1 << 29);
    mallopt(M_TOP_PAD, 1 << 26);
    const Arguments arguments = parse(argc, argv);
    const dds_entity_t participant =
        checked(dds_create_participant(arguments.domain, NULL, NULL), "a participant");
    const Ends ends = make_ends(participant, &arguments);
    const int code =
        arguments.mode == kListen ? listen_to_all(&ends, &arguments) : ask(&ends, &arguments);
    dds_delete(DDS_CYCLONEDDS_HANDLE);
    return code;
}
