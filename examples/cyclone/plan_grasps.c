// Asks graspd for grasps with Cyclone DDS alone, in C:
//
//     plan_grasps mug.off robotiq_2f_85 0.001
//
// for a file in millimetres. Ends as graspctl does: 0 grasps, 3 none, 2 invalid, 4 no reply, 1
// internal error.

#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "graspd.h"

// idlc turns graspd_msgs::msg::dds_::X_ into graspd_msgs_msg_dds__X_; on the wire the name stays.
typedef graspd_msgs_msg_dds__GraspRequest_ Request;
typedef graspd_msgs_msg_dds__RankedGrasps_ Reply;

enum { kGrasps = 0, kInternalError = 1, kInvalid = 2, kNoGrasp = 3, kNoReply = 4 };
enum { kOverloaded = graspd_msgs_msg_dds__RankedGrasps__Constants_STATUS_OVERLOADED_ };

// graspd listens on loopback, Cyclone would choose another interface; CYCLONEDDS_URI overrules
// this. All by unicast, as the loopback interface need not carry multicast (and Cyclone would say
// so at each start, were it not told "true").
static const char kLoopback[] =
    "<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>39"
    "</MaxAutoParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>";

static void fail(int code, const char* what, const char* why) {
    fprintf(stderr, "plan_grasps: %s: %s\n", what, why);
    exit(code);
}

static int checked(int result, const char* what) {
    if (result < 0) fail(kInternalError, what, dds_strretcode(-result));
    return result;
}

// The triangles of an OFF file without comments; coordinates times scale are metres in frame O.
static shape_msgs_msg_dds__Mesh_ read_off(const char* path, double scale) {
    uint32_t vertices = 0, faces = 0;
    long long read = 0;
    FILE* file = fopen(path, "r");
    if (file == NULL) fail(kInvalid, path, "cannot be opened");
    if (fscanf(file, "OFF %" SCNu32 " %" SCNu32 " %*u", &vertices, &faces) != 2) {
        fail(kInvalid, path, "is no OFF file");
    }
    shape_msgs_msg_dds__Mesh_ mesh = {
        .vertices = {vertices, vertices,
                     dds_alloc(vertices * sizeof(geometry_msgs_msg_dds__Point_))},
        .triangles = {faces, faces, dds_alloc(faces * sizeof(shape_msgs_msg_dds__MeshTriangle_))}};
    for (uint32_t i = 0; i < vertices; ++i) {
        geometry_msgs_msg_dds__Point_* p = &mesh.vertices._buffer[i];
        read += fscanf(file, "%lf %lf %lf%*[^\n]", &p->x, &p->y, &p->z);
        *p = (geometry_msgs_msg_dds__Point_){scale * p->x, scale * p->y, scale * p->z};
    }
    for (uint32_t i = 0; i < faces; ++i) {
        uint32_t* v = mesh.triangles._buffer[i].vertex_indices;
        read += fscanf(file, " 3 %" SCNu32 " %" SCNu32 " %" SCNu32 "%*[^\n]", v, v + 1, v + 2);
    }
    fclose(file);
    if (read != 3LL * vertices + 3LL * faces) fail(kInvalid, path, "is no mesh of triangles");
    return mesh;
}

static bool waits(dds_entity_t waitset, dds_time_t end) {
    return checked(dds_waitset_wait_until(waitset, NULL, 0, end), "waiting") > 0;
}

// A request written before its reader is known is lost: requests are volatile.
static void wait_for_planner(dds_entity_t waitset, dds_entity_t writer, dds_entity_t reader) {
    const dds_time_t end = dds_time() + DDS_SECS(10);
    dds_publication_matched_status_t readers = {0};
    dds_subscription_matched_status_t writers = {0};
    do {  // to read a status resets its condition
        dds_get_publication_matched_status(writer, &readers);
        dds_get_subscription_matched_status(reader, &writers);
        if (readers.current_count > 0 && writers.current_count > 0) return;
    } while (waits(waitset, end));
    fail(kNoReply, "no reply", "no planner within 10 s");
}

// Everybody's replies arrive here; ours carries both our names.
static Reply* take_reply(dds_entity_t reader, const Request* request) {
    void* sample = NULL;
    dds_sample_info_t info;
    while (checked(dds_take(reader, &sample, &info, 1, 1), "dds_take") > 0) {
        Reply* reply = sample;
        if (info.valid_data && strcmp(reply->client_id, request->client_id) == 0 &&
            strcmp(reply->request_id, request->request_id) == 0) {
            return reply;  // a loan that is kept until the process ends
        }
        dds_return_loan(reader, &sample, 1);
        sample = NULL;
    }
    return NULL;
}

// Every attempt has the same bytes under the same id: graspd plans once and answers each.
static const Reply* ask(dds_entity_t participant, const Request* request) {
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(10));
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
    const dds_entity_t requests =
        dds_create_topic(participant, &graspd_msgs_msg_dds__GraspRequest__desc,
                         "rt/graspd/grasp_request", qos, NULL);
    const dds_entity_t replies =
        dds_create_topic(participant, &graspd_msgs_msg_dds__RankedGrasps__desc,
                         "rt/graspd/ranked_grasps", qos, NULL);
    const dds_entity_t writer =
        checked(dds_create_writer(participant, requests, qos, NULL), "writer");
    dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    const dds_entity_t reader =
        checked(dds_create_reader(participant, replies, qos, NULL), "reader");
    dds_delete_qos(qos);

    const dds_entity_t waitset = checked(dds_create_waitset(participant), "waitset");
    dds_set_status_mask(writer, DDS_PUBLICATION_MATCHED_STATUS);
    dds_set_status_mask(reader, DDS_SUBSCRIPTION_MATCHED_STATUS);
    dds_waitset_attach(waitset, writer, 0);
    dds_waitset_attach(waitset, reader, 0);
    wait_for_planner(waitset, writer, reader);
    dds_waitset_detach(waitset, writer);
    dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);

    const int kRetries = 2;
    const dds_duration_t kTimeout = DDS_SECS(15);  // the time budget is 10 s by default
    const Reply* reply = NULL;
    for (int attempt = 0; attempt <= kRetries; ++attempt) {
        const dds_time_t end = dds_time() + kTimeout;
        checked(dds_write(writer, request), "dds_write");
        do reply = take_reply(reader, request);
        while (reply == NULL && waits(waitset, end));
        if (reply != NULL && reply->status != kOverloaded) return reply;
        if (reply != NULL && attempt < kRetries) dds_sleepfor(DDS_SECS(1));
    }
    if (reply == NULL) fail(kNoReply, "no reply", "the last attempt was in vain");
    return reply;
}

static int print(const Reply* reply) {
    static const char* const kNames[] = {"OK",
                                         "NO_GRASP",
                                         "PARTIAL",
                                         "INVALID_REQUEST",
                                         "UNKNOWN_OBJECT",
                                         "UNKNOWN_GRIPPER",
                                         "OVERLOADED",
                                         "CANCELLED",
                                         "INTERNAL_ERROR"};
    static const int kCodes[] = {kGrasps,  kNoGrasp, kNoGrasp, kInvalid,      kInvalid,
                                 kInvalid, kNoReply, kNoReply, kInternalError};
    if (reply->status > 8) fail(kInternalError, "status", "unknown to this program");
    printf("%s, %u grasps. %s\n", kNames[reply->status], reply->grasps._length, reply->message);
    for (uint32_t i = 0; i < reply->grasps._length; ++i) {
        const graspd_msgs_msg_dds__Grasp_* grasp = &reply->grasps._buffer[i];
        const geometry_msgs_msg_dds__Point_* p = &grasp->pose.position;
        const geometry_msgs_msg_dds__Quaternion_* q = &grasp->pose.orientation;
        printf(
            "position %.4f %.4f %.4f m, quaternion xyzw %.4f %.4f %.4f %.4f, "
            "width %.4f m, score %.3f\n",
            p->x, p->y, p->z, q->x, q->y, q->z, q->w, grasp->width, grasp->score);
    }
    if (reply->grasps._length > 0) return kGrasps;
    for (uint32_t i = 0; i < reply->report.rejections._length; ++i) {
        const graspd_msgs_msg_dds__RejectionCount_* fell = &reply->report.rejections._buffer[i];
        printf("%llu candidates: %s\n", (unsigned long long)fell->count, fell->reason);
    }
    return kCodes[reply->status];
}

int main(int argc, char** argv) {
    char client_id[64];  // differs from that of every other run: no earlier reply is taken for ours
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    snprintf(client_id, sizeof(client_id), "cyclone-%lld-%ld", (long long)now.tv_sec, now.tv_nsec);
    // Lists that stay at length 0, such as options and object_pose, are absent.
    Request request = {.header.frame_id = "object",
                       .client_id = client_id,
                       .request_id = "1",
                       .object_key = "",
                       .cloud.header.frame_id = "",
                       .gripper = "parallel_85",
                       .obstacle_cloud.header.frame_id = ""};
    if (argc < 2 || argc > 5) fail(kInvalid, "usage", "FILE.off [GRIPPER [SCALE [DOMAIN]]]");
    if (argc > 2) request.gripper = argv[2];
    request.mesh = read_off(argv[1], argc > 3 ? atof(argv[3]) : 1);
    const char* domain = argc > 4 ? argv[4] : getenv("ROS_DOMAIN_ID");
    const dds_domainid_t id = domain != NULL ? (dds_domainid_t)atoi(domain) : 0;
    if (getenv("CYCLONEDDS_URI") == NULL) checked(dds_create_domain(id, kLoopback), "domain");
    const dds_entity_t participant = checked(dds_create_participant(id, NULL, NULL), "participant");
    const int code = print(ask(participant, &request));
    dds_delete(DDS_CYCLONEDDS_HANDLE);  // takes leave, so that graspd need not wait for the lease
    return code;
}
